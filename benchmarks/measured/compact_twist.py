"""Lost motion and stiffness of the COMPAct rig from its readings, see tests/data/compact."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from pyarrow import parquet

from .compact_readings import RIG

RATIO = 7.2
STIFFNESS_SPAN = 10.0  # [N m] from which to the largest torque slopes are taken
BINS = 40  # of the lost motion, for the places where the output rests


class TwistLoop(NamedTuple):
    """Figures of the loop of torque over angle, in the angle of the file."""

    chord: float
    """Largest torque less smallest, over their angles [N m/rad]."""
    slope: float
    """Of the angle over the torque by least squares over all readings, inverted [N m/rad]."""
    loading: float
    """Likewise, of the first rise from `STIFFNESS_SPAN` [N m/rad]."""
    unloading: float
    """Likewise, of the fall from the largest torque to `STIFFNESS_SPAN` [N m/rad]."""
    width: float
    """Distance of the falling branch from the return at zero torque [rad]."""


def _play() -> NDArray[np.float64]:
    """Angle of the motor over the ratio less that of the output [rad]."""
    table = parquet.read_table(RIG / "lost_motion.parquet")
    motor, output = (
        np.asarray(table[f"{name} [rad]"], dtype=float) for name in ("motor", "output")
    )
    return np.asarray(motor / RATIO - output)


def lost_motion_in(begin: float, end: float) -> float:
    """Range of the output angle less that of the motor over the ratio [rad].

    Args:
        begin: first reading, as a part of all readings.
        end: last reading, likewise.
    """
    play = _play()
    return float(np.ptp(play[round(begin * len(play)) : round(end * len(play))]))


def resting_places() -> tuple[float, float]:
    """The most frequent play below and above the middle of its range [rad]."""
    count, edges = np.histogram(_play(), BINS)
    middles, half = 0.5 * (edges[1:] + edges[:-1]), BINS // 2
    return (
        float(middles[:half][np.argmax(count[:half])]),
        float(middles[half:][np.argmax(count[half:])]),
    )


def twist_loop() -> TwistLoop:
    """Compute the loop of the stiffness test: up, down to the opposite torque, and back to zero."""
    table = parquet.read_table(RIG / "stiffness.parquet")
    angle, torque = (
        np.asarray(table[name], dtype=float) for name in ("encoder [rad]", "torque [N m]")
    )
    top, bottom = int(np.argmax(torque)), int(np.argmin(torque))
    rise, fall = slice(0, top), slice(top, bottom)

    def slope(part: slice) -> float:
        chosen = torque[part] > STIFFNESS_SPAN
        return _stiffness(torque[part][chosen], angle[part][chosen])

    at_zero = float(np.interp(0.0, torque[bottom:top:-1], angle[bottom:top:-1]))
    return TwistLoop(
        chord=float((torque[top] - torque[bottom]) / (angle[top] - angle[bottom])),
        slope=_stiffness(torque, angle),
        loading=slope(rise),
        unloading=slope(fall),
        width=at_zero - float(angle[-1]),
    )


def _stiffness(torque: NDArray[np.float64], angle: NDArray[np.float64]) -> float:
    return float(1.0 / np.polyfit(torque, angle, 1)[0])
