"""Angle of a shaft from the phase of a line of its vibration, without a tachometer.

A band around one line, such as a mesh harmonic, has the phase of that line, which is its order
times the angle of the shaft (Bonnardot et al. 2005, Mech. Syst. Signal Process. 19, 766-785;
Leclere, Andre and Antoni 2016, Mech. Syst. Signal Process. 81, 209-230).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..spectra.spectrum import checked

Array = NDArray[np.float64]
END = 0.02  # of the samples at each end, where the band is not exact


def angle_from_line(
    samples: ArrayLike, sample_rate: float, band: tuple[float, float], order: float
) -> Array:
    """Angle of a shaft from the phase of one line (Bonnardot et al. 2005).

    The band must contain the line at every speed, and no other: it is narrower than the distance of
    the sidebands. Noise in the band moves the angle by its share of the line over sqrt(2) `order`.

    Args:
        samples: the signal at equal steps of time, in any unit, (n,), n at least 8.
        sample_rate: [Hz].
        band: lowest and highest frequency of the line [Hz].
        order: of the line [cycles per turn of the shaft], such as the tooth number for the first
            mesh harmonic and a gear relative to the carrier.

    Returns:
        Angle since the first sample, increasing [rad], (n,). It is not exact in the first and last
        fiftieth.

    Raises:
        ValueError: there are too few samples or one is not finite, the band is empty or not below
            half the sample rate, the order is not positive, or the phase runs backwards, which
            means that the band contains no line that is higher than all else in it.
    """
    values = checked(samples)
    if values.ndim != 1:
        raise ValueError(f"samples: shape {values.shape}: must be one channel, (n,)")
    if not 0.0 < order < math.inf:
        raise ValueError(f"order = {order:g}: must be positive")
    low, high = band
    frequency = np.fft.fftfreq(len(values), 1.0 / sample_rate)
    kept = (frequency >= low) & (frequency <= high)
    if not (0.0 < low < high < 0.5 * sample_rate and kept.any()):
        raise ValueError(
            f"band = {low:g}:{high:g}: must be between 0 and half the sample rate, "
            f"{0.5 * sample_rate:g} Hz, and contain a line of the spectrum"
        )
    phase = np.unwrap(np.angle(np.fft.ifft(np.where(kept, np.fft.fft(values), 0.0))))
    steps = np.diff(phase)
    end = math.ceil(END * len(steps))
    for place in np.flatnonzero(steps[end:-end] <= 0.0)[:1]:
        raise ValueError(
            f"band = {low:g}:{high:g}: the phase runs backwards at {(end + place) / sample_rate:g} "
            "s: the band must contain one line that is higher than all else in it"
        )
    # At the ends, where the record is taken as periodic, the phase may run backwards.
    forward = np.maximum(steps, 1e-9)
    return np.concatenate(([0.0], np.cumsum(forward))) / order
