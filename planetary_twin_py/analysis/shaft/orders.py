"""Computed order tracking: spectra of signals of gearboxes with varying speed.

A varying speed smears the lines of a frequency spectrum. Resampled at equal steps of the angle of
a shaft, the same signal has lines at constant orders, in cycles per turn of that shaft (Fyfe and
Munck 1997, Mech. Syst. Signal Process. 11, 187-205; Randall 2011, Vibration-based Condition
Monitoring, sec. 3.6).
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import PchipInterpolator
from scipy.signal import resample_poly

from ...gearset.kinematics import Teeth, mesh_cycles_per_turn, speed_ratios
from ..sampling.interpolation import interpolated
from ..spectra.spectrum import amplitude_spectrum, checked

Array = NDArray[np.float64]
_TURN = 2.0 * math.pi
EXACT = 0.4  # of the samples per turn: highest order with an error of at most 1 %
FINEST = 1 << 24  # resampled angles; a shaft that is almost at rest would need more
SAMPLES_PER_TURN = 512


class ByAngle(NamedTuple):
    """A signal resampled at equal steps of the angle of a shaft."""

    angle: Array
    """Angle since the first sample, increasing in the direction of rotation [rad], (n,)."""
    samples: Array
    """In the unit of the signal, (n,) or (n, channels)."""


class OrderSpectrum(NamedTuple):
    """Amplitude spectrum over orders."""

    order: Array
    """[cycles per turn], (bins,)."""
    amplitude: Array
    """Peak amplitude in the unit of the signal, (bins,) or (bins, channels)."""


class OrderMap(NamedTuple):
    """Order spectra over time."""

    time: Array
    """Centre of each window [s], (windows,)."""
    speed: Array
    """Mean speed of the shaft in each window [rad/s], (windows,)."""
    order: Array
    """[cycles per turn], (bins,)."""
    amplitude: Array
    """Peak amplitude in the unit of the signal, (windows, bins)."""


def resample_by_angle(
    samples: ArrayLike, angle: ArrayLike, samples_per_turn: int = SAMPLES_PER_TURN
) -> ByAngle:
    """Resample a signal at equal steps of the angle of a shaft (Fyfe and Munck 1997).

    The samples are interpolated (see `interpolated`); the error is at most 0.2 % for tones up to
    0.47 times the sample rate. The error of orders up to 0.4 `samples_per_turn` is at most 1 %.
    Orders above 0.6 `samples_per_turn`, which would appear as aliases of these, are reduced to 1 %
    by a filter.

    Args:
        samples: the signal at equal steps of time, in any unit, (n,) or (n, channels), n at least
            8.
        angle: of the shaft at the samples, continuous over turns [rad], (n,).
        samples_per_turn: number of samples per turn of the result, at least 4.

    Returns:
        Angle [rad] and samples, each (m,) or (m, channels).

    Raises:
        ValueError: the signal is too short or not finite, the angle has another length, or the
            shaft reverses, is at rest or turns less than two steps.
    """
    values, turned = checked(samples), one_way(angle)
    if len(values) != len(turned):
        raise ValueError(f"angle: {len(turned)} values for {len(values)} samples")
    return resampled_from(values, turned, 0.0, samples_per_turn)


def resampled_from(values: Array, turned: Array, first: float, samples_per_turn: int) -> ByAngle:
    """`resample_by_angle` from a given angle on.

    Args:
        values: the signal, (n,) or (n, channels).
        turned: angle since the first sample, increasing [rad], (n,).
        first: that of the first result [rad].
        samples_per_turn: number of samples per turn of the result, at least 4.

    Returns:
        Angle from `first` on, at which it is 0 [rad], and samples.
    """
    if samples_per_turn < 4:
        raise ValueError(f"samples_per_turn = {samples_per_turn}: must be 4 or more")
    step = _TURN / samples_per_turn
    # Fine enough at the lowest speed, so that there are no aliases before the filter.
    finer = max(1, math.ceil(step / float(np.diff(turned).min())))
    count = math.floor((turned[-1] - first) / step)
    if count < 2:
        raise ValueError(
            f"angle: turns {turned[-1] - first:.3g} rad: must be at least {2 * step:.3g}"
        )
    if count * finer > FINEST:
        raise ValueError(
            f"angle: increases by {np.diff(turned).min():.3g} rad in the slowest step and "
            f"{np.diff(turned).max():.3g} in the fastest; exclude standstill"
        )
    grid = first + step / finer * np.arange(count * finer)
    places = PchipInterpolator(turned, np.arange(len(turned)))(grid)
    fine = interpolated(values, places)
    coarse = fine if finer == 1 else resample_poly(fine, 1, finer, axis=0, padtype="line")
    return ByAngle(step * np.arange(count), coarse)


def order_spectrum(
    samples: ArrayLike,
    angle: ArrayLike,
    samples_per_turn: int = SAMPLES_PER_TURN,
    window: str = "hann",
) -> OrderSpectrum:
    """Amplitude spectrum over orders of a shaft (Fyfe and Munck 1997).

    The amplitudes are scaled as in `amplitude_spectrum`. The order resolution is the inverse of
    the number of turns in the signal.

    Args:
        samples: the signal in any unit, (n,) or (n, channels), n at least 8.
        angle: of the shaft at the samples, continuous over turns [rad], (n,).
        samples_per_turn: see `resample_by_angle`; the highest order is half of it.
        window: name of a window of `scipy.signal.get_window`.

    Returns:
        Order [cycles per turn] (bins,) and peak amplitude (bins,) or (bins, channels).

    Raises:
        ValueError: see `resample_by_angle` and `amplitude_spectrum`.
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
    """Order spectra of successive windows of a signal, with a Hann window.

    Windows overlap by half; they are further apart if there would be more than `most_windows`.

    Args:
        samples: the signal in any unit, (n,), n at least 8.
        time: of the samples [s], (n,).
        angle: of the shaft at the samples, continuous over turns [rad], (n,).
        turns: length of a window in turns of the shaft.
        most_windows: largest number of windows.
        samples_per_turn: see `resample_by_angle`; the highest order is half of it.

    Returns:
        Time [s] and speed [rad/s] of the windows (windows,), order [cycles per turn] (bins,) and
        peak amplitude (windows, bins).

    Raises:
        ValueError: see `order_spectrum`; or the signal has several channels or is shorter than
            `turns`.
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
    begin, end = (np.interp(edge, one_way(angle), np.asarray(time)) for edge in edges)
    windows = [resampled.samples[start : start + length] for start in starts]
    spectra = amplitude_spectrum(np.column_stack(windows), samples_per_turn)
    speed = (edges[1] - edges[0]) / (end - begin)
    return OrderMap(0.5 * (begin + end), speed, spectra.frequency, spectra.amplitude.T)


def mesh_order(teeth: Teeth, held: str, member: str) -> Fraction:
    """Mesh order: the number of teeth that pass a mesh per turn of a member.

    It follows from the speeds of Willis (1841). Harmonics are at integer multiples of it, and
    sidebands of faults at integer distances from these. If both inputs of a differential turn, the
    number is not constant; use the angle of the sun relative to the carrier, for which the mesh
    order is the number of teeth of the sun.

    Args:
        teeth: tooth numbers of sun, planet and ring.
        held: member at rest, "sun", "ring" or "carrier".
        member: "sun", "ring", "carrier" or "planet". The turns of a planet are absolute, like its
            recorded angle.

    Returns:
        The mesh order [cycles per turn of `member`], exact.

    Raises:
        ValueError: `held` or `member` is not a member of the gearset, or `member` is at rest.
    """
    if member != "planet":
        return abs(mesh_cycles_per_turn(teeth, speed_ratios(teeth, held, member)))
    ratios = speed_ratios(teeth, held, "sun" if held != "sun" else "carrier")
    if ratios["planet"] == 0:
        raise ValueError(f"member = 'planet': is at rest if the {held} is held")
    return abs(mesh_cycles_per_turn(teeth, ratios) / ratios["planet"])


def one_way(angle: ArrayLike) -> Array:
    """Angle since the first sample [rad], increasing; raises `ValueError` if the shaft reverses."""
    turned = checked(angle, "angle")
    if turned.ndim != 1:
        raise ValueError(f"angle: shape {turned.shape}: must be that of one shaft, (n,)")
    steps = np.diff(turned)
    sense = np.sign(steps[np.flatnonzero(steps)[:1]].sum())
    wrong = np.flatnonzero(sense * steps <= 0.0)
    if len(wrong):
        raise ValueError(f"angle: reverses or stands still after sample {wrong[0]}")
    return np.asarray(sense * (turned - turned[0]), dtype=np.float64)
