"""Spectra of uniformly sampled signals.

In an amplitude spectrum the height of a line is the peak amplitude of a tone, independently of
window and length. The integral of a power spectral density is the variance. Sources: Randall 2011,
Vibration-based Condition Monitoring, ch. 3, and Harris 1978, Proc. IEEE 66, 51-83.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import signal as filters

Array = NDArray[np.float64]
FEWEST_SAMPLES = 8  # the main lobe of a Hann window is four bins wide


class Spectrum(NamedTuple):
    """One-sided amplitude spectrum."""

    frequency: Array
    """[Hz], (bins,)."""
    amplitude: Array
    """Peak amplitude in the unit of the signal, (bins,) or (bins, channels)."""


class PowerDensity(NamedTuple):
    """One-sided power spectral density."""

    frequency: Array
    """[Hz], (bins,)."""
    density: Array
    """In the squared unit of the signal per Hz, (bins,) or (bins, channels)."""


class Line(NamedTuple):
    """A line of a spectrum."""

    place: float
    """Frequency [Hz] or order [cycles per turn]."""
    amplitude: float
    """Peak amplitude in the unit of the signal."""


def amplitude_spectrum(samples: ArrayLike, sample_rate: float, window: str = "hann") -> Spectrum:
    """One-sided amplitude spectrum (Harris 1978; Randall 2011, ch. 3).

    The height of a tone a sin(2 pi f t + p) below half the sample rate is a if f is the frequency
    of a bin. Otherwise it is lower by up to 15 % with a Hann window and 0.1 % with "flattop"
    (scalloping loss); `strongest_lines` corrects that. The value at 0 Hz is the magnitude of the
    mean. The mean with the weights of the window is subtracted first and does not leak.

    Args:
        samples: the signal in any unit, (n,) or (n, channels), n at least 8.
        sample_rate: [Hz].
        window: name of a window of `scipy.signal.get_window`.

    Returns:
        Frequency [Hz] (bins,) and peak amplitude (bins,) or (bins, channels).

    Raises:
        ValueError: there are too few samples, a sample is not finite, the sample rate is not
            positive, or the window is unknown.
    """
    values, rate = checked(samples), _positive(sample_rate, "sample_rate")
    count = len(values)
    weights = _window(window, count).reshape(-1, *[1] * (values.ndim - 1))
    # The mean of the window: that of the samples has a share of tones with a part of a cycle, which
    # would be a line in the first bin.
    middle = (values * weights).sum(axis=0) / weights.sum()
    amplitude = np.abs(np.fft.rfft((values - middle) * weights, axis=0)) / weights.sum()
    # Half of a tone is at its negative frequency; 0 and the Nyquist frequency have none.
    amplitude[1 : (count + 1) // 2] *= 2.0
    amplitude[0] = np.abs(values.mean(axis=0))
    half = count // 2
    frequency = np.linspace(0.0, rate * half / count, half + 1)
    return Spectrum(frequency, amplitude)


def power_density(
    samples: ArrayLike, sample_rate: float, segment: int | None = None, window: str = "hann"
) -> PowerDensity:
    """One-sided power spectral density by Welch's method.

    The periodograms of segments that overlap by half are averaged; the mean of each segment is
    subtracted (Welch 1967, IEEE Trans. Audio Electroacoust. 15, 70-73). The sum over the bins times
    their spacing is the variance of the segments.

    Args:
        samples: the signal in any unit, (n,) or (n, channels), n at least 8.
        sample_rate: [Hz].
        segment: length of a segment in samples, at least 8; None is an eighth of the signal.
        window: name of a window of `scipy.signal.get_window`.

    Returns:
        Frequency [Hz] (bins,) and density (bins,) or (bins, channels).

    Raises:
        ValueError: see `amplitude_spectrum`; or `segment` is too short, or longer than the signal.
    """
    values, rate = checked(samples), _positive(sample_rate, "sample_rate")
    length = max(len(values) // 8, FEWEST_SAMPLES) if segment is None else segment
    if not FEWEST_SAMPLES <= length <= len(values):
        raise ValueError(
            f"segment = {length}: must be within {FEWEST_SAMPLES} and {len(values)} samples"
        )
    _window(window, length)  # for our error message if the name is unknown
    return PowerDensity(*filters.welch(values, rate, window, length, axis=0))


def strongest_lines(axis: ArrayLike, amplitude: ArrayLike, count: int = 10) -> list[Line]:
    """The highest lines of a spectrum with a Hann window.

    Place and height between the bins follow from the ratio of the two highest bins of each peak
    (Grandke 1983, IEEE Trans. Instrum. Meas. 32, 350-355). They are exact for a single tone; the
    error of the height is at most 1 % for tones more than four bins from each other and from both
    ends. The mean is not a line.

    Args:
        axis: frequency [Hz] or order [cycles per turn], uniformly spaced, (bins,).
        amplitude: peak amplitude in any unit, (bins,).
        count: largest number of lines, at least 1.

    Returns:
        The lines, highest first.

    Raises:
        ValueError: the shapes differ, there are fewer than three bins, or `count` is below 1.
    """
    x, a = np.asarray(axis, dtype=np.float64), np.asarray(amplitude, dtype=np.float64)
    if x.ndim != 1 or x.shape != a.shape or len(x) < 3:
        raise ValueError(
            f"amplitude: shape {a.shape}: must be that of the axis {x.shape}, at least 3 bins"
        )
    if count < 1:
        raise ValueError(f"count = {count}: must be at least 1")
    a = np.concatenate(([0.0], a[1:], [0.0]))  # without the mean; the last bin may be a peak
    peaks = 1 + np.flatnonzero((a[1:-1] > a[:-2]) & (a[1:-1] >= a[2:]))
    places, heights = _interpolated(x, a, peaks)
    highest = np.argsort(-heights, kind="stable")[:count]
    return [Line(float(places[k]), float(heights[k])) for k in highest]


def _interpolated(x: Array, a: Array, peaks: NDArray[np.intp]) -> tuple[Array, Array]:
    """Places and heights of the lines at `peaks`."""
    side = np.where(a[peaks + 1] >= a[peaks - 1], 1, -1)
    ratio = a[peaks + side] / a[peaks]
    # Bins from the peak towards `side`.
    beyond = np.maximum((2.0 * ratio - 1.0) / (ratio + 1.0), 0.0)
    heights = a[peaks] * (1.0 - beyond**2) / np.sinc(beyond)
    return x[peaks] + side * beyond * (x[1] - x[0]), heights


def checked(samples: ArrayLike, name: str = "samples") -> Array:
    """`samples` as floats; raises `ValueError` if there are too few, or one is not finite."""
    values = np.asarray(samples, dtype=np.float64)
    if values.ndim == 0 or len(values) < FEWEST_SAMPLES:
        found = len(values) if values.ndim else 1
        raise ValueError(f"{name}: {found} values: must be at least {FEWEST_SAMPLES}")
    bad = ~np.isfinite(values).reshape(len(values), -1).all(axis=1)
    if bad.any():
        raise ValueError(
            f"{name}: not finite at index {np.flatnonzero(bad)[0]}; exclude such samples"
        )
    return values


def _positive(value: float, name: str) -> float:
    if not (np.isfinite(value) and value > 0.0):
        raise ValueError(f"{name} = {value:g}: must be positive")
    return float(value)


def _window(name: str, length: int) -> Array:
    try:
        return filters.get_window(name, length)
    except ValueError:
        raise ValueError(f"window = {name!r}: must be one of scipy.signal.get_window") from None
