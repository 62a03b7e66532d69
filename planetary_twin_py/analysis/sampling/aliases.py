"""Aliases in the spectrum of uniformly spaced samples.

Sampled at the rate R, a tone of frequency f above R/2 appears at |f - n R|, where the integer n
brings it below R/2 (Randall 2011, Vibration-based Condition Monitoring, sec. 3.2). The waveform of
a twin consists of values at instants; no filter precedes the sampling.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from ...units.engineering import percent

EDGE = 0.8  # of half the sample rate: lines above it are about as high as those beyond
NEGLIGIBLE = 0.01  # of the highest line: height of aliases up to which the rate is sufficient
ZONES = 4  # halves of the sample rate up to which harmonics are considered
PER_MODE = 4.0  # recommended sample rate over the highest natural frequency


def edge_amplitude(frequency: ArrayLike, amplitude: ArrayLike) -> float:
    """Height of the lines just below half the sample rate, in the unit of the amplitudes.

    Aliases have about this height, because spectra of a gear train decrease without jumps.

    Args:
        frequency: from 0 to half the sample rate [Hz], (bins,).
        amplitude: (bins,), the mean first.
    """
    axis, heights = np.asarray(frequency), np.asarray(amplitude)
    return float(heights[axis >= EDGE * axis[-1]].max())


def alias_share(frequency: ArrayLike, amplitude: ArrayLike) -> float:
    """Approximate height of aliases over that of the highest line; 0 if all lines are zero.

    The sample rate is sufficient if it is at most `NEGLIGIBLE`.

    Args:
        frequency: from 0 to half the sample rate [Hz], (bins,).
        amplitude: (bins,), the mean first.
    """
    highest = float(np.asarray(amplitude)[1:].max())
    return edge_amplitude(frequency, amplitude) / highest if highest > 0.0 else 0.0


def alias_frequency(frequency: float, sample_rate: float) -> float:
    """Frequency at which a tone appears in the spectrum of its samples.

    Args:
        frequency: of the tone [Hz, or cycles per turn].
        sample_rate: in the same unit.
    """
    return abs(frequency - sample_rate * round(frequency / sample_rate))


def aliased_harmonic(place: float, mesh: float, sample_rate: float, near: float) -> int | None:
    """Lowest harmonic above half the sample rate whose alias is at `place`.

    Args:
        place: of a line [Hz, or cycles per turn]; the other arguments have the same unit.
        mesh: mesh frequency.
        sample_rate: of the signal.
        near: largest distance from `place`.

    Returns:
        Number of the harmonic, or None.
    """
    first = math.floor(0.5 * sample_rate / mesh) + 1
    last = math.floor(0.5 * ZONES * sample_rate / mesh)
    for harmonic in range(first, last + 1):
        if abs(alias_frequency(harmonic * mesh, sample_rate) - place) <= near:
            return harmonic
    return None


def alias_remark(
    sample_rate: float, share: float, highest_mode: float | None, mesh: float | None
) -> str:
    """Warning about a spectrum with aliases.

    Args:
        sample_rate: [Hz].
        share: from `alias_share`.
        highest_mode: highest natural frequency of the train [Hz], above which spectra decrease;
            None if it is unknown.
        mesh: mesh frequency [Hz]; None if it is unknown.

    Returns:
        A sentence with the recommended sample rate.
    """
    better = max(2.0 * sample_rate, PER_MODE * (highest_mode or 0.0))
    first = "" if not mesh else f" (mesh harmonics from {0.5 * sample_rate / mesh:.3g} on)"
    return (
        f"the sample rate of {sample_rate:g} Hz is too low for this signal: components above "
        f"{0.5 * sample_rate:g} Hz{first} appear as aliases, and lines of up to about "
        f"{percent(share)} of the highest may be aliases; record at {better:.3g} Hz or more"
    )
