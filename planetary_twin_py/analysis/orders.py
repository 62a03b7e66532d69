"""Computed order tracking: what happens a fixed number of times per turn, at any speed.

A gearbox that changes its speed smears every line of a plain spectrum. Sampled anew at equal steps
of a shaft's angle, the same signal has its lines at orders, in cycles per turn of that shaft, and
they stay (Fyfe and Munck 1997, Mech. Syst. Signal Process. 11, 187-205; Randall 2011,
Vibration-based Condition Monitoring, sec. 3.6).
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline
from scipy.signal import resample_poly

from ..gearset.kinematics import Teeth, mesh_cycles_per_turn, speed_ratios
from .spectrum import amplitude_spectrum, checked

Array = NDArray[np.float64]
_TURN = 2.0 * math.pi
FINEST = 1 << 24  # angles at once; more come of a shaft that all but stands still
SAMPLES_PER_TURN = 512


class ByAngle(NamedTuple):
    """`angle` [rad] (n,) in equal steps, counted up in the sense of turning; `samples` (n, ...)."""

    angle: Array
    samples: Array


class OrderSpectrum(NamedTuple):
    """`order` [cycles per turn] (bins,); `amplitude` (bins, ...), peak, in the signal's unit."""

    order: Array
    amplitude: Array


class OrderMap(NamedTuple):
    """Order spectra over time: `amplitude` (windows, bins), peak, in the signal's unit.

    `time` [s] (windows,) of the middle of each window, `speed` [rad/s] (windows,) the mean within,
    `order` [cycles per turn] (bins,).
    """

    time: Array
    speed: Array
    order: Array
    amplitude: Array


def resample_by_angle(
    samples: ArrayLike, angle: ArrayLike, samples_per_turn: int = SAMPLES_PER_TURN
) -> ByAngle:
    """Samples (n,) or (n, channels) at equal steps of the shaft's continuous `angle` [rad] (n,).

    By cubic splines, which leave tones up to a quarter of the sample rate within 1.5 %. Orders up
    to 0.4 `samples_per_turn` are kept to 1 %; those beyond 0.6, which would fold back among them,
    are filtered out to 1 %.

    Raises:
        ValueError: the signal is too short or not finite, the angle does not match or the shaft
            turns back, stands still, or turns less than two steps.
    """
    values, turned = checked(samples), _one_way(angle)
    if len(values) != len(turned):
        raise ValueError(f"angle: {len(turned)} values for {len(values)} samples")
    if samples_per_turn < 4:
        raise ValueError(f"samples_per_turn = {samples_per_turn}: must be 4 or more")
    step = _TURN / samples_per_turn
    # Fine enough where the shaft is slowest, so that nothing folds back before the filter.
    finer = max(1, math.ceil(step / float(np.diff(turned).min())))
    count = math.floor(turned[-1] / step)
    if count < 2:
        raise ValueError(f"angle: turns {turned[-1]:.3g} rad: less than two steps of {step:.3g}")
    if count * finer > FINEST:
        raise ValueError(
            f"angle: turns {np.diff(turned).min():.3g} rad in the slowest step, "
            f"{np.diff(turned).max():.3g} in the fastest: leave standstill out"
        )
    grid = step / finer * np.arange(count * finer)
    fine = CubicSpline(turned, values)(grid)
    coarse = fine if finer == 1 else resample_poly(fine, 1, finer, axis=0, padtype="line")
    return ByAngle(step * np.arange(count), coarse)


def order_spectrum(
    samples: ArrayLike,
    angle: ArrayLike,
    samples_per_turn: int = SAMPLES_PER_TURN,
    window: str = "hann",
) -> OrderSpectrum:
    """Amplitude spectrum over orders of the shaft with the continuous `angle` [rad] (n,).

    Scaled as `amplitude_spectrum`; the orders are resolved to one over the turns in the signal.

    Raises:
        ValueError: as `resample_by_angle` and `amplitude_spectrum`.
    """
    resampled = resample_by_angle(samples, angle, samples_per_turn).samples
    return OrderSpectrum(*amplitude_spectrum(resampled, samples_per_turn, window))


def order_map(
    samples: ArrayLike,
    time: ArrayLike,
    angle: ArrayLike,
    turns: float = 8.0,
    most_windows: int = 400,
    samples_per_turn: int = SAMPLES_PER_TURN,
) -> OrderMap:
    """Order spectra (Hann) of windows of `turns` turns of the shaft, over time [s] (n,).

    Windows overlap by half, or lie further apart if there would be more than `most_windows`.

    Raises:
        ValueError: as `order_spectrum`; `samples` have several channels, or last less than `turns`.
    """
    resampled = resample_by_angle(samples, angle, samples_per_turn)
    length = round(turns * samples_per_turn)
    if resampled.samples.ndim != 1:
        raise ValueError(f"samples: shape {resampled.samples.shape}: must be one channel")
    if not 0 < length <= len(resampled.samples) or most_windows < 1:
        raise ValueError(
            f"turns = {turns:g}, most_windows = {most_windows}: both must be positive, "
            f"the signal has {len(resampled.samples) / samples_per_turn:.3g} turns"
        )
    room = len(resampled.samples) - length
    count = min(1 + 2 * room // length, most_windows)
    starts = np.rint(np.linspace(0.0, room, count)).astype(np.intp)
    edges = resampled.angle[starts], resampled.angle[starts] + length * resampled.angle[1]
    begin, end = (np.interp(edge, _one_way(angle), np.asarray(time)) for edge in edges)
    windows = [resampled.samples[start : start + length] for start in starts]
    spectra = amplitude_spectrum(np.column_stack(windows), samples_per_turn)
    speed = (edges[1] - edges[0]) / (end - begin)
    return OrderMap(0.5 * (begin + end), speed, spectra.frequency, spectra.amplitude.T)


def mesh_order(teeth: Teeth, held: str, member: str) -> Fraction:
    """Teeth that pass each mesh per turn of `member`: the order of the meshing.

    `member` is "sun", "ring", "carrier" or "planet" (about the gearbox's axis and its pin together,
    as its angle is recorded). Sidebands and harmonics lie at whole numbers around and of it. With
    both inputs of a differential turning, there is no such number: take the angle of the sun
    against the carrier, of which the order is always the sun's number of teeth.

    Raises:
        ValueError: `held` or `member` is no member, or is at rest.
    """
    if member != "planet":
        return abs(mesh_cycles_per_turn(teeth, speed_ratios(teeth, held, member)))
    ratios = speed_ratios(teeth, held, "sun" if held != "sun" else "carrier")
    if ratios["planet"] == 0:
        raise ValueError(f"member = 'planet': is at rest with the {held} held")
    return abs(mesh_cycles_per_turn(teeth, ratios) / ratios["planet"])


def _one_way(angle: ArrayLike) -> Array:
    """The angle turned since the first sample, counted up."""
    turned = checked(angle, "angle")
    if turned.ndim != 1:
        raise ValueError(f"angle: shape {turned.shape}: must be of one shaft")
    turned = (turned - turned[0]) * np.sign(turned[-1] - turned[0])
    wrong = np.flatnonzero(np.diff(turned) <= 0.0)
    if len(wrong):
        raise ValueError(f"angle: turns back or stands still after sample {wrong[0]}")
    return turned
