"""Lines that stand out of noise, and of what leaks from higher lines.

The amplitude of Gaussian noise in a bin exceeds k times its median with the probability 2^(-k^2)
(Rayleigh distribution). The mean power of M spectra has a gamma distribution of order M, of which
this is the case M = 1 (Welch 1967, IEEE Trans. Audio Electroacoust. 15, 70-73). With a Hann window,
a tone x bins away, which is d bins from the nearest bin, leaks the share
sin(pi d) / (pi x (x^2 - 1)) of its height (Harris 1978, Proc. IEEE 66, 51-83).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.special import gammaincc, gammainccinv, gammaincinv

from ..spectra.spectrum import Line, strongest_lines

Array = NDArray[np.float64]
DISTINCT = 5.0  # ratio of a line that is named: 14 dB; one bin of noise in 3e7 exceeds it
PREDICTED = 1e-3  # chance of noise, below which a line at a place known beforehand is named
PLACES = 3  # bins that are searched at such a place
AROUND = 64  # bins on each side whose median is the noise
_LOBE = 2.0  # [bins] half the width of the main lobe
_ROUNDING = 1e-12  # of the highest line, below which amplitudes are numerical noise


def chance(ratio: float, averages: int = 1, bins: int = 1) -> float:
    """Probability that noise is as high over its median, in at least one of some bins.

    Args:
        ratio: amplitude over the median of the noise.
        averages: number of spectra whose power is averaged.
        bins: number of bins.
    """
    scale = float(gammaincinv(averages, 0.5))
    one = float(gammaincc(averages, scale * ratio**2))
    return -math.expm1(bins * math.log1p(-one)) if one < 1.0 else 1.0


def distinct_ratio(averages: int = 1) -> float:
    """Ratio of a line that is named wherever it is: of one spectrum `DISTINCT`.

    Args:
        averages: number of spectra whose power is averaged.
    """
    rare = 2.0 ** -(DISTINCT**2)
    return math.sqrt(float(gammainccinv(averages, rare) / gammaincinv(averages, 0.5)))


def over_noise(
    axis: Array, amplitude: Array, lines: Sequence[Line], error: float = 0.0
) -> list[float]:
    """Heights of the bins of lines over the noise around them, or over the leakage of higher lines.

    Args:
        axis: frequency [Hz] or order [cycles per turn], uniformly spaced, (bins,).
        amplitude: with a Hann window, in any unit, (bins,).
        lines: of this spectrum.
        error: of interpolated samples, over the height of a tone; lower lines than this share of
            the highest may be products of the interpolation, and are not distinct.

    Returns:
        The ratio of each line to the higher of both, to be compared with `DISTINCT`.
    """
    every = np.array(strongest_lines(axis, amplitude, len(axis))).reshape(-1, 2)
    places, heights = every[:, 0] / axis[1], every[:, 1]
    least = max(_ROUNDING, error / DISTINCT) * heights.max(initial=0.0)
    found = []
    for line in lines:
        bin_ = round(line.place / float(axis[1]))
        noise = np.median(amplitude[max(bin_ - AROUND, 1) : bin_ + AROUND + 1])
        higher = heights > line.amplitude
        away = np.maximum(np.abs(places[higher] - bin_), _LOBE)
        beside = np.abs(np.sin(np.pi * places[higher]))  # the bins are at whole numbers
        leaked = heights[higher] * beside / (np.pi * away * (away**2 - 1.0))
        height = float(amplitude[max(bin_ - 1, 1) : bin_ + 2].max())  # of a bin, as the noise is
        found.append(height / max(float(noise), float(leaked.sum()), least))
    return found
