"""Losses of the COMPAct rig: estimated from some operating points, predicted at others.

The scene's loss torque is nearly linear in the friction coefficient and in the drag, so both follow
from linear least squares about the values of the scene. Prediction intervals are those of linear
regression (Draper and Smith 1998, Applied Regression Analysis, ch. 3) with Student's t: their
scatter is that of the fitted operating points about the model, not the noise of the readings.
"""

from __future__ import annotations

import csv
from collections.abc import Iterator
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.stats import t as student

import planetary_twin_py as pt

from .compact_readings import RIG
from .compact_twist import RATIO
from .row import PREDICTION, Row, verdict

Array = NDArray[np.float64]

SCENE = "compact_actuator"
FITTED = "lubrication.boundary_coefficient", "losses.sun_drag.coulomb"
STEPS = 0.05, 5e-3  # of both, for slopes
LEVEL = 0.95
SLOWEST = 4.0  # [rpm] of the output, below which the rig loses more than at higher speeds


class Points(NamedTuple):
    """Operating points, (n,) each."""

    torque: Array
    """That the motor is to give, referred to the output [N m]."""
    speed: Array
    """Of the output [rpm]."""
    loss: Array
    """Measured loss torque, referred to the output [N m]."""

    def chosen(self, rows: NDArray[np.bool_]) -> Points:
        """Some of them."""
        return Points(*(column[rows] for column in self))


class Estimates(NamedTuple):
    """Friction coefficient and drag [N m], and their uncertainty."""

    values: Array
    """(2,)."""
    covariance: Array
    """(2, 2)."""
    scatter: float
    """Standard deviation of an operating point about the model [N m]."""
    freedom: int
    """Degrees of freedom of the scatter."""


def read_points(name: str) -> Points:
    """Means over each operating point of a table of the rig.

    Args:
        name: of the file in tests/data/compact.
    """
    with (RIG / name).open(newline="") as file:
        rows = list(csv.DictReader(file))
    labels = [row["operating_point"] for row in rows]
    columns = ("input_torque", "input_speed [rpm]", "output_torque")
    values = np.array([[float(row[column]) for column in columns] for row in rows])
    means = np.array(
        [values[[label == one for label in labels]].mean(axis=0) for one in dict.fromkeys(labels)]
    )
    torque, speed = RATIO * means[:, 0], means[:, 1] / RATIO
    return Points(torque, speed, torque + means[:, 2])


def twin_losses(scene: pt.Scene, points: Points) -> Array:
    """Loss torque of the twin at operating points, referred to the output [N m].

    Args:
        scene: of the rig.
        points: where.
    """
    scenes = [
        scene.replace(
            dynamics="quasi_static", input_torque=torque / RATIO, input_speed=pt.rpm(RATIO * speed)
        )
        for torque, speed in zip(points.torque, points.speed, strict=True)
    ]
    duration = 0.05
    power = [run.result.mean_power_loss for run in pt.simulate_many(scenes, duration=duration)]
    return np.array(power) / (points.speed * np.pi / 30.0)


def slopes_at(points: Points) -> tuple[Array, Array]:
    """Loss torque of the packaged scene and its slopes over friction and drag, (n,) and (n, 2).

    Args:
        points: where.
    """
    scene = pt.load_scene(SCENE)
    base = twin_losses(scene, points)
    slopes = [
        (twin_losses(scene.replace(**{name: _value(scene, name) + step}), points) - base) / step
        for name, step in zip(FITTED, STEPS, strict=True)
    ]
    return base, np.column_stack(slopes)


def _value(scene: pt.Scene, name: str) -> float:
    for part in name.split("."):
        scene = getattr(scene, part)
    return float(scene)  # type: ignore[arg-type]


def estimate(loss: Array, base: Array, slopes: Array) -> Estimates:
    """Estimate friction and drag by least squares.

    Args:
        loss: measured loss torque [N m], (n,).
        base: of the packaged scene, (n,).
        slopes: over friction and drag, (n, 2).
    """
    scene = pt.load_scene(SCENE)
    change, *_ = np.linalg.lstsq(slopes, loss - base, rcond=None)
    left = loss - base - slopes @ change
    freedom = len(loss) - len(change)
    scatter = float(np.sqrt(left @ left / freedom))
    values = np.array([_value(scene, name) for name in FITTED]) + change
    return Estimates(values, scatter**2 * np.linalg.inv(slopes.T @ slopes), scatter, freedom)


def prediction(found: Estimates, base: Array, slopes: Array) -> tuple[Array, Array]:
    """Predicted loss torque and half of its 95 % interval [N m], (n,) each.

    Args:
        found: from other operating points.
        base: of the packaged scene, (n,).
        slopes: over friction and drag, (n, 2).
    """
    scene = pt.load_scene(SCENE)
    change = found.values - np.array([_value(scene, name) for name in FITTED])
    variance = found.scatter**2 + np.einsum("np,pq,nq->n", slopes, found.covariance, slopes)
    quantile = float(student.ppf(0.5 + 0.5 * LEVEL, found.freedom))
    return base + slopes @ change, quantile * np.sqrt(variance)


@cache
def steady() -> tuple[Points, Array, Array]:
    """All steady operating points with the twin's loss and slopes."""
    points = read_points("losses.csv")
    return points, *slopes_at(points)


def rig_losses() -> Iterator[Row]:
    """Losses at operating points that the estimate has not used."""
    points, base, slopes = steady()
    speed, torque = np.round(points.speed, -1), np.round(points.torque)
    parts = {
        "20 rpm, predicted from 10 and 30 rpm": speed == 20.0,
        "30 rpm, predicted from 10 and 20 rpm": speed == 30.0,
        "10 rpm, predicted from 20 and 30 rpm": speed == 10.0,
        "even torques, predicted from odd ones": torque % 2.0 == 0.0,
        "13 to 18 N m, predicted from 1 to 12 N m": torque > 12.5,
    }
    for what, out in parts.items():
        found = estimate(points.loss[~out], base[~out], slopes[~out])
        row = _row(what, points.chosen(out), prediction(found, base[out], slopes[out]))
        yield row
    found = estimate(points.loss, base, slopes)
    ramps = read_points("ramps.csv")
    for what, rows in {
        f"falling ramps, {SLOWEST:g} to 30 rpm": ramps.speed >= SLOWEST,
        f"falling ramps below {SLOWEST:g} rpm": ramps.speed < SLOWEST,
    }.items():
        some = ramps.chosen(rows)
        what = f"{what}, predicted from all steady runs"
        yield _row(what, some, prediction(found, *slopes_at(some)))
    yield from _efficiencies(points, base)


def _row(what: str, points: Points, predicted: tuple[Array, Array]) -> Row:
    error, reach = predicted[0] - points.loss, predicted[1]
    rms = float(np.sqrt(np.mean((error / points.loss) ** 2)))
    inside = float(np.mean(np.abs(error) <= reach))
    return Row(
        f"loss torque at the output, {what}",
        f"{points.loss.min():.2f} to {points.loss.max():.2f} N m, {len(error)} operating points",
        f"rms error {100 * rms:.1f} %, largest {np.abs(error).max():.3f} N m; intervals of +- "
        f"{reach.min():.3f} to {reach.max():.3f} N m cover {100 * inside:.0f} %",
        verdict(rms < 0.10 and inside >= 0.9),
        "bound: 10 % rms, and the 95 % intervals cover at least 90 %. Friction and drag are "
        "estimated. On the rig, the loss is not quite a linear function of the torque: at all "
        "speeds, errors of successive torques have the same sign. Below 4 rpm the losses of the "
        "rig rise, because of friction in creep or of its drives; those of the twin do not.",
    )


def _efficiencies(points: Points, base: Array) -> Iterator[Row]:
    torque = np.round(points.torque)
    for value in (1.0, 6.0, 7.0, 18.0):
        rows = torque == value
        measured, twin = (
            float(1.0 - np.mean(loss[rows] / points.torque[rows])) for loss in (points.loss, base)
        )
        yield Row(
            f"efficiency at {value:g} N m",
            f"{100 * measured:.1f} %",
            f"{100 * twin:.1f} %",
            verdict(abs(measured - twin) < 0.03),
            "bound: 3 percentage points. The scene is estimated from these runs, too.",
        )


def rig_estimates() -> Iterator[Row]:
    """Friction and drag from all steady runs, and whether speed matters."""
    points, base, slopes = steady()
    found = estimate(points.loss, base, slopes)
    scene = pt.load_scene(SCENE)
    quantile = float(student.ppf(0.5 + 0.5 * LEVEL, found.freedom))
    for place, (name, unit) in enumerate(zip(FITTED, ("", " N m"), strict=True)):
        reach = quantile * float(np.sqrt(found.covariance[place, place]))
        yield Row(
            f"`{name}`",
            f"{found.values[place]:.4f} +- {reach:.4f}{unit}",
            f"{_value(scene, name):g}{unit} in the scene",
            verdict(abs(_value(scene, name) - found.values[place]) < reach),
            "bound: the 95 % interval of the estimate from 54 steady runs. The friction "
            "coefficient also contains friction of the planet pins and an error of the motor's "
            "torque constant, which are proportional to the load, too. The rig does not measure "
            "its motor torque: an error of 5 % would be half of the loss that grows with the load.",
        )
    trend, reach = speed_trend(points, base, slopes, found)
    yield Row(
        "loss torque at the output, dependence on speed that the twin does not model",
        f"{1e3 * trend:+.2f} +- {1e3 * reach:.2f} mN m/rpm",
        "0",
        verdict(abs(trend) < reach),
        "bound: the 95 % interval contains zero, so no drag that rises with speed is estimated.",
    )


def speed_trend(
    points: Points, base: Array, slopes: Array, found: Estimates
) -> tuple[float, float]:
    """Slope of the residuals over the speed, and half of its 95 % interval [N m/rpm].

    Args:
        points: that were estimated.
        base: of the packaged scene, (n,).
        slopes: over friction and drag, (n, 2).
        found: the estimates.
    """
    change = found.values - _of_scene(pt.load_scene(SCENE))
    speed = points.speed - points.speed.mean()
    left = points.loss - base - slopes @ change
    quantile = float(student.ppf(0.5 + 0.5 * LEVEL, found.freedom))
    reach = quantile * found.scatter / float(np.sqrt(speed @ speed))
    return float(speed @ left / (speed @ speed)), reach


def rig_predictions() -> Iterator[Row]:
    """Losses at speeds without a steady run."""
    points, base, slopes = steady()
    found = estimate(points.loss, base, slopes)
    _, trend = speed_trend(points, base, slopes, found)
    torque = np.array([1.0, 6.0, 12.0, 18.0])
    for speed in (5.0, 15.0, 25.0, 40.0, 50.0):
        there = Points(torque, np.full(4, speed), np.full(4, np.nan))
        loss, reach = prediction(found, *slopes_at(there))
        reach = np.hypot(reach, trend * (speed - points.speed.mean()))
        shown = ", ".join(f"{value:.2f}" for value in loss)
        yield Row(
            f"loss torque at the output, {speed:g} rpm; 1, 6, 12 and 18 N m",
            "-",
            f"{shown} N m, each +- {reach.max():.2f} N m",
            PREDICTION,
            "95 % intervals from all steady runs. They contain the uncertainty of the estimates, "
            "the scatter of operating points, and the dependence on speed that is not modelled.",
        )


def _of_scene(scene: pt.Scene) -> Array:
    return np.array([_value(scene, name) for name in FITTED])
