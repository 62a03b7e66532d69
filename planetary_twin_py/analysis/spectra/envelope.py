"""Envelope of a signal, and the spectrum of its square.

Impacts that excite a resonance modulate it at their rate: the spectrum of the squared envelope
shows this rate, where the spectrum of the signal has a hill (Ho and Randall 2000, Mech. Syst.
Signal Process. 14, 763-788; Antoni 2007, Mech. Syst. Signal Process. 21, 597-630).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .spectrum import Spectrum, amplitude_spectrum, checked

Array = NDArray[np.float64]


def envelope(
    samples: ArrayLike, sample_rate: float, band: tuple[float, float] | None = None
) -> Array:
    """Envelope: the magnitude of the analytic signal (Ho and Randall 2000).

    Args:
        samples: the signal in any unit, (n,), n at least 8.
        sample_rate: [Hz], or samples per turn of a signal over angle.
        band: lowest and highest frequency that are used [Hz, or orders]; default: all.

    Returns:
        The envelope in the unit of the signal, (n,). The mean of the signal is not in it.

    Raises:
        ValueError: there are too few samples or one is not finite, there are several channels, or
            the band is empty or not below half the sample rate.
    """
    values = checked(samples)
    if values.ndim != 1:
        raise ValueError(f"samples: shape {values.shape}: must be one channel, (n,)")
    if not (np.isfinite(sample_rate) and sample_rate > 0.0):
        raise ValueError(f"sample_rate = {sample_rate:g}: must be positive")
    frequency = np.fft.fftfreq(len(values), 1.0 / sample_rate)
    low, high = band if band is not None else (0.0, 0.5 * sample_rate)
    kept = (frequency > 0.0) & (frequency >= low) & (frequency <= high)
    if not (0.0 <= low < high <= 0.5 * sample_rate and kept.any()):
        raise ValueError(
            f"band = {low:g}:{high:g}: must be within 0 and {0.5 * sample_rate:g}, half the sample "
            "rate, and contain a line of the spectrum"
        )
    return np.abs(np.fft.ifft(2.0 * np.where(kept, np.fft.fft(values), 0.0)))


def squared_envelope_spectrum(
    samples: ArrayLike,
    sample_rate: float,
    band: tuple[float, float] | None = None,
    window: str = "hann",
) -> Spectrum:
    """Amplitude spectrum of the squared envelope (Ho and Randall 2000; Antoni 2007).

    A carrier of amplitude 1 which is modulated by 1 + m cos has the lines 2 m at the modulation and
    m^2/2 at twice that; the mean is 1 + m^2/2.

    Args:
        samples: the signal in any unit, (n,), n at least 8.
        sample_rate: [Hz], or samples per turn of a signal over angle.
        band: lowest and highest frequency that are demodulated [Hz, or orders]; default: all. Its
            width is the highest frequency of the result with a meaning.
        window: name of a window of `scipy.signal.get_window`.

    Returns:
        Frequency [Hz, or orders] and peak amplitude in the squared unit of the signal, (bins,); the
        value at 0 is the mean.

    Raises:
        ValueError: see `envelope` and `amplitude_spectrum`.
    """
    return amplitude_spectrum(envelope(samples, sample_rate, band) ** 2, sample_rate, window)
