"""Spectral kurtosis: in which band a signal consists of impacts.

Antoni 2006, Mech. Syst. Signal Process. 20, 282-307: 0 for stationary Gaussian noise, -1 for a tone
and 2/q - 2 for noise that is present a share q of the time.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.signal.windows import hann

from .spectrum import checked

Array = NDArray[np.float64]
FEWEST_SEGMENTS = 8


class SpectralKurtosis(NamedTuple):
    """Spectral kurtosis over frequency."""

    frequency: Array
    """[Hz], without 0 and half the sample rate, (bins,)."""
    kurtosis: Array
    """Dimensionless, (bins,); NaN where the signal is zero."""
    segments: int
    """Number of segments, which overlap by half."""


def spectral_kurtosis(
    samples: ArrayLike, sample_rate: float, segment: int = 256
) -> SpectralKurtosis:
    """Spectral kurtosis over segments with a Hann window (Antoni 2006).

    It is the mean of the fourth power of a spectral magnitude over the squared mean of its square,
    less 2.

    Segments must be shorter than the distance of two impacts and longer than an impact.

    Args:
        samples: the signal in any unit, (n,).
        sample_rate: [Hz].
        segment: length of a segment in samples, even, at least 8.

    Returns:
        Frequency [Hz] and kurtosis, (bins,), and the number of segments. Of Gaussian noise, the
        standard deviation is about 2/sqrt(segments).

    Raises:
        ValueError: a sample is not finite, there are several channels, the sample rate is not
            positive, the length of a segment is odd or too short, or there are fewer than eight.
    """
    values = checked(samples)
    if values.ndim != 1:
        raise ValueError(f"samples: shape {values.shape}: must be one channel, (n,)")
    if not (np.isfinite(sample_rate) and sample_rate > 0.0):
        raise ValueError(f"sample_rate = {sample_rate:g}: must be positive")
    if segment < 8 or segment % 2:
        raise ValueError(f"segment = {segment}: must be even and at least 8")
    count = max((len(values) - segment) // (segment // 2) + 1, 0)
    if count < FEWEST_SEGMENTS:
        raise ValueError(
            f"segment = {segment}: {count} segments in {len(values)} samples: must be at "
            f"least {FEWEST_SEGMENTS}"
        )
    segments = np.lib.stride_tricks.sliding_window_view(values, segment)[:: segment // 2]
    spectra = np.fft.rfft(segments * hann(segment, sym=False), axis=1)[:, 1:-1]
    power = np.abs(spectra) ** 2
    square, mean = (power**2).mean(axis=0), power.mean(axis=0)
    with np.errstate(invalid="ignore"):
        found = square / mean**2 - 2.0
    frequency = np.linspace(0.0, 0.5 * sample_rate, segment // 2 + 1)[1:-1]
    return SpectralKurtosis(frequency, found, len(segments))
