"""What a duty does not say, although damage depends on it."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ..scene import Scene
from .damage_map import DamageMap
from .duty_table import STD, Duty
from .excerpts import MapError, is_course
from .steady_damage import unsteady_remark

Array = NDArray[np.float64]
FAST = 0.5  # [s] below which torque is faster than what a map of steady runs is made for
ACCURATE = 0.02  # error of a map up to which nothing is said
EXAMPLE = 0.1  # relative standard deviation within a row


def remarks_of(scene: Scene, duty: Duty, exponent: float) -> Iterator[str]:
    """A line for each doubt about a duty.

    Args:
        scene: the gearbox.
        duty: the duty.
        exponent: p, of damage over torque, of the part that fails first.

    Yields:
        The lines.
    """
    if "oil_temperature" not in duty.columns:
        heat = scene.operating_point.oil_temperature - 273.15
        yield f"no column oil_temperature: {heat:.4g} degC of the scene counts throughout"
    row = float(np.median(duty.held))
    fine = is_course(duty) and row <= FAST
    if not fine and STD not in duty.columns and exponent > 1.0:
        what = f"rows of {row:g} s have" if duty.time is not None else "the rows have"
        factor = 1.0 + 0.5 * exponent * (exponent - 1.0) * EXAMPLE**2
        yield (
            f"{what} no column input_torque_std: missing is the factor 1 + p(p - 1)s^2/2 of the "
            f"damage, with p = {exponent:.3g} here and the relative standard deviation s of the "
            f"torque within a row; it is {factor:.3g} for s = {EXAMPLE:g}"
        )
    if fine and (found := correlation_time(duty)) < FAST:
        yield (
            f"the torque changes within {found:.2g} s (autocorrelation 1/e), faster than {FAST:g} "
            "s: the map takes every instant as steady running; the measured error of the map is "
            "what this costs"
        )


def map_remarks(table: DamageMap, error: MapError, part: str) -> Iterator[str]:
    """A line for each doubt about a map of damage.

    Args:
        table: the map, after it has been used.
        error: of it.
        part: tooth or bearing that fails first; "" without damage.

    Yields:
        The lines.
    """
    if table.extrapolated:
        yield (
            f"{', '.join(table.extrapolated)}: stresses above the first point of the S-N curve, "
            "which is extrapolated"
        )
    if line := unsteady_remark(table.unsteady, table.runs):
        yield line
    largest = float(error.largest[table.parts.index(part)]) if part else 0.0
    if not math.isfinite(largest):
        yield f"error of the map: unknown for {part}, which the direct runs do not damage"
    elif largest > ACCURATE:
        yield (
            f"error of the map: up to {100.0 * largest:.2g} % of the damage of {part} (95 %), more "
            f"than {100.0 * ACCURATE:g} %; more --excerpts narrow its interval"
        )


def correlation_time(duty: Duty) -> float:
    """Lag at which the autocorrelation of the torque falls to 1/e [s]; infinite if it is constant.

    Args:
        duty: with times.
    """
    torque = duty.columns["input_torque"]
    step = float(np.median(duty.held))
    even = np.interp(np.arange(len(torque)) * step, np.cumsum(duty.held) - duty.held, torque)
    even = even - even.mean()
    if not even.any():
        return np.inf
    size = 1 << (2 * len(even) - 1).bit_length()
    power = np.abs(np.fft.rfft(even, size)) ** 2
    correlation = np.fft.irfft(power, size)[: len(even)]
    correlation /= correlation[0]
    below = np.flatnonzero(correlation < np.exp(-1.0))
    if not len(below):
        return len(even) * step
    k = int(below[0])
    high, low = correlation[k - 1], correlation[k]
    return float((k - 1 + (high - np.exp(-1.0)) / (high - low)) * step)
