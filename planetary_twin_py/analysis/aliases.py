"""What evenly spaced samples do not carry: tones above half their rate fold back below it.

A tone of f Hz sampled at R Hz looks like one of |f - n R| Hz, n the whole number that brings it
below R/2 (Randall 2011, Vibration-based Condition Monitoring, sec. 3.2). The waveform of a twin is
the motion itself at instants, without a filter before them.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

EDGE = 0.8  # of half the sample rate: lines above it are about as high as those beyond
CARRIED = 0.01  # of the highest line, which lines there may be for the samples to carry a signal
ZONES = 4  # halves of the sample rate up to which harmonics are looked for
PER_MODE = 4.0  # sample rate over the highest natural frequency, at which lines fall off


def edge_amplitude(frequency: ArrayLike, amplitude: ArrayLike) -> float:
    """Height of the lines next to half the sample rate, in the unit of the amplitudes.

    What folds back below it is about as high, as spectra of a gear train fall off without jumps.

    Args:
        frequency: from 0 to half the sample rate [Hz], (bins,).
        amplitude: (bins,), the mean first.
    """
    axis, heights = np.asarray(frequency), np.asarray(amplitude)
    return float(heights[axis >= EDGE * axis[-1]].max())


def alias_share(frequency: ArrayLike, amplitude: ArrayLike) -> float:
    """`edge_amplitude` over the highest line, about the height of aliases; 0 of no signal.

    Up to `CARRIED` the samples carry the signal.
    """
    highest = float(np.asarray(amplitude)[1:].max())
    return edge_amplitude(frequency, amplitude) / highest if highest > 0.0 else 0.0


def folded(frequency: float, sample_rate: float) -> float:
    """Where a tone stands in the spectrum of its samples, all in one unit."""
    return abs(frequency - sample_rate * round(frequency / sample_rate))


def folded_harmonic(place: float, mesh: float, sample_rate: float, near: float) -> int | None:
    """Lowest harmonic of `mesh` beyond half the sample rate that folds to `place` within `near`.

    All in one unit, Hz or cycles per turn; None where none does.
    """
    first = math.floor(0.5 * sample_rate / mesh) + 1
    last = math.floor(0.5 * ZONES * sample_rate / mesh)
    for harmonic in range(first, last + 1):
        if abs(folded(harmonic * mesh, sample_rate) - place) <= near:
            return harmonic
    return None


def fitting_rate(sample_rate: float, highest_mode: float | None) -> float:
    """A sample rate [Hz] that is worth a try where `sample_rate` does not do.

    Args:
        sample_rate: [Hz].
        highest_mode: natural frequency of the train [Hz], above which spectra fall off; None if it
            is not known.
    """
    return max(2.0 * sample_rate, PER_MODE * (highest_mode or 0.0))


def alias_remark(
    sample_rate: float, share: float, highest_mode: float | None, mesh: float | None
) -> str:
    """What readers of a spectrum must know whose samples do not carry the signal.

    Args:
        sample_rate: [Hz].
        share: height of the lines next to half of it over that of the highest line.
        highest_mode: see `fitting_rate`.
        mesh: mesh frequency [Hz], if known.
    """
    first = (
        "" if not mesh else f" (harmonics of the meshing from {0.5 * sample_rate / mesh:.3g} on)"
    )
    return (
        f"{sample_rate:g} samples per second do not carry this signal: lines next to "
        f"{0.5 * sample_rate:g} Hz are {100.0 * share:.2g} % of the highest, and what lies above"
        f"{first} folds back below: lines of that height and less may be aliases; record at "
        f"{fitting_rate(sample_rate, highest_mode):.3g} Hz or more"
    )
