"""Estimation of scene parameters from the course of a manoeuvre: reversal, run-up or ramp."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ...following.checks.checked_bins import checked_table
from ...following.sensors import Sensors
from ...following.train import followed_train
from ...scene import Scene
from .course import FEWEST, Array, Course, read_course
from .course_model import CourseModel
from .estimate import Estimate, conclude
from .least_squares import Minimum, Residuals, differentiate, minimise, with_initial_magnitudes
from .parameter import Parameter, read_parameters
from .residual_runs import Runs, count_runs

CONFIDENCE = 0.95
LEAST = 1e-9  # [N m] smallest noise
NEAR = 1e-2  # distance within which a parameter is at an end of its range, over its scale
SLOW = 0.01  # share of the largest speed below which the sign of the loss is unknown
LARGEST = 0.98  # upper limit of the correlation of successive residuals


@dataclass(frozen=True)
class FittedCourse:
    """Estimated parameters of a manoeuvre."""

    scene: Scene
    parameters: tuple[Parameter, ...]
    estimate: Estimate
    course: Course
    """Fitted part of the manoeuvre."""
    simulated: Array
    """Input torque at the estimate [N m], (n,)."""
    noise: float
    """Standard deviation of the residuals [N m]."""
    correlation: float
    """Correlation of successive residuals."""
    runs: Runs | None
    held_out: Course | None
    predicted: Array | None
    """Input torque over the part that was held out [N m]."""
    reach: Array | None
    """Half of its 95 % interval [N m]."""
    simulations: int
    processor_time: float
    """[s]"""
    unit_remarks: tuple[str, ...]
    """A line for each unit of the table that may be wrong, and for readings that are left out."""
    without_effect: tuple[bool, ...]
    """Whether the simulated torque stays the same for any small change of each parameter."""

    @property
    def inside(self) -> float:
        """Share of the readings that were held out within their intervals; NaN without any."""
        if self.held_out is None or self.predicted is None or self.reach is None:
            return math.nan
        return float(np.mean(np.abs(self.predicted - self.held_out.input_torque) <= self.reach))


def fit_course(
    path: Path,
    scene: Scene,
    free: Sequence[str],
    start: Mapping[str, Any] | None = None,
    span: tuple[float, float] = (-math.inf, math.inf),
    hold_out: tuple[float, float] | None = None,
    report: Callable[[int], None] = lambda count: None,
    sensors: Sensors | None = None,
) -> FittedCourse:
    """Estimate free parameters from the torque at the input over a manoeuvre.

    The weight of successive residuals is reduced by their correlation, as for a first-order
    autoregressive process (Bartlett 1946).

    Args:
        path: path of the file, see `read_course`.
        scene: scene of the gearbox.
        free: dotted names of the free fields of the scene.
        start: initial values, by name.
        span: start and end of the part that is fitted [s].
        hold_out: start and end of a part that is predicted [s].
        report: called with the number of simulated points.
        sensors: accuracy of the sensors, against which the signs of the torques are checked, names
            of columns, and factors on readings; None: the default.

    Returns:
        The estimates.

    Raises:
        InputError: readings contradict the scene; names channel, value and correction.
        ValueError: a name, a value or the file is invalid, or a part has too few bins.
        ArithmeticError: the scene cannot be simulated.
        OSError: the file cannot be read.
    """
    began = time.process_time()
    known = sensors or Sensors()
    unit_remarks: list[str] = []

    def check(stamps: Array, columns: Mapping[str, Array]) -> Mapping[str, Array]:
        judged = checked_table(scene, known, stamps, columns)
        unit_remarks.extend(judged.remarks)
        return judged.columns

    manoeuvre = _without_standstill(read_course(path, followed_train(scene), known, check))
    course = _select_part(manoeuvre, span)
    if hold_out is not None and hold_out[0] < course.time[-1] and hold_out[1] > course.time[0]:
        raise ValueError(
            f"hold_out = {hold_out[0]:g} to {hold_out[1]:g} s: overlaps the fitted part, "
            f"{course.time[0]:g} to {course.time[-1]:g} s"
        )
    parameters = read_parameters(scene, free, start or {})
    model = CourseModel(scene, tuple(free), report)
    parameters = with_initial_magnitudes(_scaled_by_start(model, course, parameters), parameters)
    minimum, noise, correlation = _minimise(model, course, parameters)
    weight = _weight(noise, correlation)
    freedom = max(len(course.time) * (1.0 - correlation) / (1.0 + correlation), 2.0)
    estimate = conclude(model.residuals(course, weight), parameters, minimum, freedom, CONFIDENCE)
    simulated = _require_torque(model.at(minimum.values, course))
    runs = count_runs(simulated - course.input_torque)
    held_out = predicted = reach = None
    if hold_out is not None:
        held_out = _select_part(manoeuvre, hold_out)
        predicted, reach = _predict(model, held_out, parameters, estimate, noise, freedom)
    return FittedCourse(
        scene, parameters, estimate, course, simulated, noise, correlation, runs, held_out,
        predicted, reach, model.count, time.process_time() - began, tuple(unit_remarks),
        tuple(not slopes.any() for slopes in minimum.slopes.T),
    )  # fmt: skip


def _scaled_by_start(
    model: CourseModel, course: Course, parameters: tuple[Parameter, ...]
) -> Residuals:
    """Residuals, divided by their root mean square at the start."""
    (first,) = model.residuals(course, 1.0)([np.array([p.start for p in parameters])])
    size = 1.0 if first is None else math.sqrt(float(np.mean(first**2)))
    return model.residuals(course, 1.0 / max(size, LEAST))


def _minimise(
    model: CourseModel, course: Course, parameters: tuple[Parameter, ...]
) -> tuple[Minimum, float, float]:
    """The minimum with its weight, and standard deviation and correlation of the residuals there.

    The weight is the same for all bins, so the minimum does not depend on it.
    """
    start = np.array([p.start for p in parameters])
    minimum = minimise(model.residuals(course, 1.0), parameters, start)
    residuals = minimum.residuals
    sum_of_squares = float(residuals @ residuals)
    noise = max(math.sqrt(sum_of_squares / max(len(residuals) - len(parameters), 1)), LEAST)
    autocorrelation = (
        float(residuals[1:] @ residuals[:-1]) / sum_of_squares if sum_of_squares > 0.0 else 0.0
    )
    correlation = min(max(autocorrelation, 0.0), LARGEST)
    weight = _weight(noise, correlation)
    return (
        Minimum(minimum.values, weight * minimum.residuals, weight * minimum.slopes),
        noise,
        correlation,
    )


def _weight(noise: float, correlation: float) -> float:
    return math.sqrt((1.0 - correlation) / (1.0 + correlation)) / noise


def _predict(
    model: CourseModel,
    course: Course,
    parameters: tuple[Parameter, ...],
    found: Estimate,
    noise: float,
    freedom: float,
) -> tuple[Array, Array]:
    """Input torque over another part, and half of its interval [N m]."""
    from scipy.stats import t

    predicted = _require_torque(model.at(found.values, course))
    slopes = differentiate(model.residuals(course, 1.0), parameters, found.values)
    estimate_variance = np.einsum("mp,pq,mq->m", slopes, found.covariance, slopes)
    quantile = float(t.ppf(0.5 + 0.5 * CONFIDENCE, freedom))
    return predicted, quantile * np.sqrt(estimate_variance + noise**2)


def _without_standstill(course: Course) -> Course:
    """Remove standstill, where the sign of the loss is unknown."""
    moving = np.abs(course.speed) > SLOW * float(np.abs(course.speed).max())
    return Course(*(values[moving] for values in course))


def _select_part(course: Course, span: tuple[float, float]) -> Course:
    part = course.between(*span)
    if len(part.time) < FEWEST:
        raise ValueError(
            f"{span[0]:g} to {span[1]:g} s: {len(part.time)} bins while the train turns, must be "
            f"at least {FEWEST}"
        )
    return part


def _require_torque(torque: Array | None) -> Array:
    if torque is None:
        raise ArithmeticError("the manoeuvre cannot be simulated with these parameters")
    return torque


def _reason(found: FittedCourse, members: Sequence[int]) -> str:
    """Why parameters are not identifiable."""
    if len(members) > 1:
        return "only a combination is: a change of one compensates a change of another"
    if not found.without_effect[members[0]]:
        return "its effect on the torque is smaller than the residuals"
    return "the simulated torque does not change with it"


def course_remarks(found: FittedCourse) -> Iterator[str]:
    """Warn about parameters and residuals of a fit, a line per warning."""
    yield from found.unit_remarks
    estimate = found.estimate
    for members in estimate.not_identifiable:
        names = " and ".join(found.parameters[k].name for k in members)
        yield f"{names}: not identifiable from this manoeuvre: {_reason(found, members)}"
    for k, parameter in enumerate(found.parameters):
        value, margin = float(estimate.values[k]), NEAR * parameter.scale
        if value - parameter.low <= margin or parameter.high - value <= margin:
            end = parameter.low if value - parameter.low <= margin else parameter.high
            yield (
                f"{parameter.name}: is at the end of its range, {end:.3g} {parameter.unit}".rstrip()
                + "; the model lacks a loss, or another field is wrong"
            )
    if found.runs is not None and not found.runs.noise:
        yield (
            f"the residuals are not noise: {found.runs.runs} runs of one sign, "
            f"{found.runs.expected:.0f} expected in random order, correlation "
            f"{found.correlation:.2f}; an effect that changes slowly is not modelled; intervals "
            "are widened accordingly"
        )
