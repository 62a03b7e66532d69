"""Estimation of the parameters of a gearbox from a recording: the complete procedure."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ...run.counters import Course
from ...simulation.threads import Threads
from .estimate import Estimate, conclude
from .excerpt import Excerpt, read_excerpt
from .least_squares import Minimum, explained, minimise, with_initial_magnitudes
from .least_squares import search as find_least
from .measured_losses import check_losses
from .misfit import WeightedReadings, means_of, measure_noise
from .missing_loss import MissingLoss, find_missing_loss
from .model import Model, ModelOutput, read_all
from .parameter import Parameter, read_parameters
from .prediction import Fitted, Predicted, predict
from .readings import (
    HARMONICS,
    USUAL,
    Array,
    Readings,
    check_observables,
    recorded,
    usual_observables,
)
from .simulations import Simulations

ROUNDS = 4  # iterations of the noise estimate from the residuals at the minimum
SETTLED = 0.05  # relative change of the noise at which the iteration has converged


class Search(NamedTuple):
    """Free parameters, observables and known noise."""

    free: Sequence[str]
    """Dotted names of fields of the scene."""
    observe: Sequence[str] | None = None
    """See `readings.OBSERVABLES`; None: those of `readings.USUAL` that are recorded."""
    start: Mapping[str, Any] = {}
    """Initial values that differ from the recorded ones."""
    noise: Mapping[str, float] = {}
    """Standard deviation of a reading by observable, in SI, if known."""
    confidence: float = 0.95


@dataclass(frozen=True)
class Identified:
    """Estimated parameters of a recording."""

    parameters: tuple[Parameter, ...]
    estimate: Estimate
    excerpt: Excerpt
    contact_fraction: float
    """Smallest of any mesh, in the simulation at the estimate."""
    course: Course
    """Counters of that simulation, from which its accuracy is estimated."""
    weighted: WeightedReadings
    confidence: float
    """Level of the intervals."""
    sum: float
    """Sum of squares at the estimate."""
    residuals: tuple[Array, ...]
    """Simulated less recorded means by observable, in SI, (operating points, channels) each."""
    missing_loss: MissingLoss | None
    """A loss absent from the model that would explain the residuals, or None."""
    predictions: tuple[Predicted, ...]
    """Predictions of the part that was held out, by observable; empty without such a part."""
    simulations: int
    wall_time: float
    """[s]"""


def identify(
    path: str | Path,
    search: Search,
    namespace: str | None = None,
    begin: float | None = None,
    end: float | None = None,
    report: Callable[[int], None] = lambda simulations: None,
    hold_out: tuple[float, float] | None = None,
) -> Identified:
    """Estimate the free parameters of `search` from the recording at `path`.

    Args:
        path: an .mcap file, or its folder.
        search: free parameters, observables and noise.
        namespace: namespace of the gearbox, if the recording has several.
        begin: start of the part of the longest run to use [s]; None: see `read_excerpt`.
        end: its end [s].
        report: called with the number of completed simulations.
        hold_out: start and end of another part [s], which is predicted and not fitted.

    Returns:
        The estimates.

    Raises:
        ValueError: a name or value is invalid, or the recording has no such part.
        ArithmeticError: the part cannot be simulated.
    """
    began = time.perf_counter()
    _check(search)
    waveform = HARMONICS in (search.observe or USUAL)
    excerpt = read_excerpt(Path(path), namespace, begin, end, waveform)
    check_losses(excerpt)
    parameters = read_parameters(excerpt.scene, search.free, search.start)
    observe = usual_observables(excerpt) if search.observe is None else tuple(search.observe)
    data = _read_data(observe, excerpt)
    model = Model(excerpt, tuple(search.free), observe)
    runs = Simulations(model, Threads(), report)

    def weigh(values: Array) -> WeightedReadings:
        return measure_noise(
            data, _require_output(runs, values).readings, excerpt.tolerance, search.noise
        )

    weighted = weigh(np.array([p.start for p in parameters]))
    if weighted.count < len(parameters):
        raise ValueError(
            f"free = {', '.join(search.free)}: {weighted.count} mean readings do not determine "
            f"{len(parameters)} parameters; use more observables or more operating points"
        )
    parameters = with_initial_magnitudes(runs.residuals(weighted), parameters)
    weighted, minimum = _minimise(runs, weigh, weighted, parameters)
    estimate = conclude(
        runs.residuals(weighted), parameters, minimum, weighted.freedom, search.confidence
    )
    output = _require_output(runs, minimum.values)
    predictions: tuple[Predicted, ...] = ()
    if hold_out is not None:
        _check_apart(excerpt, hold_out)
        other = read_excerpt(Path(path), namespace, *hold_out, waveform)
        check_losses(other)
        others = Simulations(Model(other, model.free, observe), runs.threads, report)
        fitted = Fitted(parameters, estimate, weighted, search.confidence)
        predictions = predict(others, _read_data(observe, other), fitted)
    return Identified(
        parameters=parameters,
        estimate=estimate,
        excerpt=excerpt,
        contact_fraction=output.contact_fraction,
        course=output.course,
        weighted=weighted,
        confidence=search.confidence,
        sum=minimum.sum,
        residuals=tuple(
            means_of(s) - means_of(r) for s, r in zip(output.readings, data, strict=True)
        ),
        predictions=predictions,
        missing_loss=_missing_loss(runs, weighted, parameters, minimum, estimate),
        simulations=runs.count,
        wall_time=time.perf_counter() - began,
    )


def _minimise(
    runs: Simulations,
    weigh: Callable[[Array], WeightedReadings],
    weighted: WeightedReadings,
    parameters: tuple[Parameter, ...],
) -> tuple[WeightedReadings, Minimum]:
    """Find the minimum, with the noise estimated from the residuals there, by iteration."""
    minimum = find_least(runs.residuals(weighted), parameters)
    for _ in range(ROUNDS):
        closer = weigh(minimum.values)
        if closer.near(weighted, SETTLED):
            break
        weighted = closer
        minimum = minimise(runs.residuals(weighted), parameters, minimum.values)
        if not explained(minimum):
            minimum = min(
                minimum, find_least(runs.residuals(weighted), parameters), key=lambda m: m.sum
            )
    return weighted, minimum


def _check(search: Search) -> None:
    observe = USUAL if search.observe is None else search.observe
    check_observables(observe)
    for name, value in search.noise.items():
        if name not in observe:
            raise ValueError(f"noise = {name}: must be one of observe")
        if not 0.0 < value < math.inf:
            raise ValueError(f"noise of {name} = {value!r}: must be above 0")
    if not 0.0 < search.confidence < 1.0:
        raise ValueError(f"confidence = {search.confidence!r}: must be between 0 and 1")


def _check_apart(excerpt: Excerpt, hold_out: tuple[float, float]) -> None:
    begin, end = hold_out
    if begin < excerpt.end - 1e-9 and end > excerpt.start + 1e-9:
        raise ValueError(
            f"hold_out = {begin:g} to {end:g} s: overlaps the fitted part, {excerpt.start:g} to "
            f"{excerpt.end:g} s"
        )


def _read_data(observe: Sequence[str], excerpt: Excerpt) -> tuple[Readings, ...]:
    data = read_all(observe, recorded(excerpt), excerpt)
    for readings in data:
        if not np.all(np.isfinite(readings.values)):
            raise ValueError(
                f"observe = {readings.name}: has NaN or infinite values in this excerpt"
            )
    return data


def _missing_loss(
    runs: Simulations,
    weighted: WeightedReadings,
    parameters: Sequence[Parameter],
    minimum: Minimum,
    estimate: Estimate,
) -> MissingLoss | None:
    """Missing loss, if noise does not explain the residuals or an estimate is at its bound."""
    enough = len(minimum.residuals) > len(parameters)
    if not enough or (explained(minimum) and not any(estimate.at_bound)):
        return None

    def trial(field: str, value: float) -> Array | None:
        wider = runs.freeing(field)
        return wider.residuals(weighted)([np.append(minimum.values, value)])[0]

    return find_missing_loss(runs.scene, parameters, minimum, trial)


def _require_output(runs: Simulations, values: Array) -> ModelOutput:
    output = runs.at([values])[0]
    if output is None:
        raise ArithmeticError(f"the excerpt cannot be simulated with free parameters = {values}")
    return output
