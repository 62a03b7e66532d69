"""Spectra of evenly sampled signals, scaled so that what is read off is what was measured.

An amplitude spectrum shows tones: a line's height is the tone's peak amplitude, whatever the window
and the length. A power spectral density shows noise: its integral is the variance. Both after
Randall 2011, Vibration-based Condition Monitoring, ch. 3, and Harris 1978, Proc. IEEE 66, 51-83.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import signal as filters

Array = NDArray[np.float64]
FEWEST_SAMPLES = 8  # a Hann window's main lobe alone is four bins wide


class Spectrum(NamedTuple):
    """`frequency` [Hz] (bins,); `amplitude` (bins, ...), peak, in the unit of the signal."""

    frequency: Array
    amplitude: Array


class PowerDensity(NamedTuple):
    """`frequency` [Hz] (bins,); `density` (bins, ...) in the signal's unit squared per Hz."""

    frequency: Array
    density: Array


class Line(NamedTuple):
    """A tone: `place` in the unit of the axis, peak `amplitude`."""

    place: float
    amplitude: float


def amplitude_spectrum(samples: ArrayLike, sample_rate: float, window: str = "hann") -> Spectrum:
    """One-sided amplitude spectrum of `samples` (n,) or (n, channels) at `sample_rate` [Hz].

    A tone a sin(2 pi f t + p) between 0 and half the sample rate has the height a, if f is a bin;
    else up to 15 % less with a Hann window (scalloping), 0.1 % with "flattop";
    `strongest_lines` takes that out. The magnitude of the mean stands at 0 Hz and does not leak.
    `window` is any that `scipy.signal.get_window` knows by name.

    Raises:
        ValueError: `samples` are too few or not finite, the rate is not positive, or the window is
            unknown.
    """
    values, rate = checked(samples), _positive(sample_rate, "sample_rate")
    count = len(values)
    weights = _window(window, count).reshape(-1, *[1] * (values.ndim - 1))
    mean = values.mean(axis=0)
    amplitude = np.abs(np.fft.rfft((values - mean) * weights, axis=0)) / weights.sum()
    # Half of a tone stands at its negative frequency; 0 and the Nyquist frequency have none.
    amplitude[1 : (count + 1) // 2] *= 2.0
    amplitude[0] = np.abs(mean)
    half = count // 2
    frequency = np.linspace(0.0, rate * half / count, half + 1)
    return Spectrum(frequency, amplitude)


def power_density(
    samples: ArrayLike, sample_rate: float, segment: int | None = None, window: str = "hann"
) -> PowerDensity:
    """One-sided power spectral density of `samples` (n,) or (n, channels), by Welch's method.

    Averages over segments of `segment` samples (without it: an eighth of all) that overlap by half,
    each less its mean (Welch 1967, IEEE Trans. Audio Electroacoust. 15, 70-73). The sum times the
    spacing of the bins is the variance of the segments.

    Raises:
        ValueError: as `amplitude_spectrum`, or `segment` is longer than the signal.
    """
    values, rate = checked(samples), _positive(sample_rate, "sample_rate")
    length = max(len(values) // 8, FEWEST_SAMPLES) if segment is None else segment
    if not FEWEST_SAMPLES <= length <= len(values):
        raise ValueError(
            f"segment = {length}: must be within {FEWEST_SAMPLES} and {len(values)} samples"
        )
    _window(window, length)  # a name that is unknown is told as ours
    return PowerDensity(*filters.welch(values, rate, window, length, axis=0))


def strongest_lines(axis: ArrayLike, amplitude: ArrayLike, count: int = 10) -> list[Line]:
    """The `count` highest lines of a spectrum with a Hann window, (bins,) each, highest first.

    Place and height between the bins follow from the ratio of the two highest bins of each peak
    (Grandke 1983, IEEE Trans. Instrum. Meas. 32, 350-355): exact for a lone tone, and within
    1 % in height for tones more than four bins apart from each other and from both ends. The mean
    is no line.

    Raises:
        ValueError: the two do not match, or `count` is not positive.
    """
    x, a = np.asarray(axis, dtype=np.float64), np.asarray(amplitude, dtype=np.float64)
    if x.ndim != 1 or x.shape != a.shape or len(x) < 3:
        raise ValueError(
            f"amplitude: shape {a.shape}: must be that of the axis {x.shape}, 3 or more"
        )
    if count < 1:
        raise ValueError(f"count = {count}: must be 1 or more")
    a = np.concatenate(([0.0], a[1:], [0.0]))  # without the mean; the last bin may be a peak
    peaks = 1 + np.flatnonzero((a[1:-1] > a[:-2]) & (a[1:-1] >= a[2:]))
    lines = [_interpolated(x, a, int(k)) for k in peaks]
    return sorted(lines, key=lambda line: -line.amplitude)[:count]


def _interpolated(x: Array, a: Array, peak: int) -> Line:
    side = 1 if a[peak + 1] >= a[peak - 1] else -1
    ratio = a[peak + side] / a[peak]
    beyond = max((2.0 * ratio - 1.0) / (ratio + 1.0), 0.0)  # bins from the peak towards `side`
    height = a[peak] * (1.0 - beyond**2) / np.sinc(beyond)
    return Line(float(x[peak] + side * beyond * (x[1] - x[0])), float(height))


def checked(samples: ArrayLike, name: str = "samples") -> Array:
    """`samples` as floats; raises `ValueError` where they are too few or not finite."""
    values = np.asarray(samples, dtype=np.float64)
    if values.ndim == 0 or len(values) < FEWEST_SAMPLES:
        found = len(values) if values.ndim else 1
        raise ValueError(f"{name}: {found} of them: must be {FEWEST_SAMPLES} or more")
    bad = ~np.isfinite(values).reshape(len(values), -1).all(axis=1)
    if bad.any():
        raise ValueError(f"{name}: not finite at {np.flatnonzero(bad)[0]}: leave such samples out")
    return values


def _positive(value: float, name: str) -> float:
    if not (np.isfinite(value) and value > 0.0):
        raise ValueError(f"{name} = {value:g}: must be positive")
    return float(value)


def _window(name: str, length: int) -> Array:
    try:
        return filters.get_window(name, length)
    except ValueError:
        raise ValueError(f"window = {name!r}: scipy.signal.get_window knows none") from None
