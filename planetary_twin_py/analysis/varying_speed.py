"""How far a varying speed lowers the lines of a spectrum over frequency.

A shaft that is ahead of its mean speed by the angle d turns a line of order N by the phase N d. The
line loses the share P^2/2 of its height, where P is the rms of these phases with the weights of the
window.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from scipy.signal import get_window

from .even_steps import PHASE
from .mesh_spectrum import MeshSpectrum
from .signals import MEAN, Array, Signal


def exact_order(angle: Array) -> float:
    """Order [cycles per turn] of the line that the speed lowers by 1 %; infinite if it is constant.

    Args:
        angle: of the shaft at equally spaced times [rad], (n,), n at least 3.
    """
    number = np.arange(len(angle)) / (len(angle) - 1)
    window = get_window("hann", len(angle))
    line = np.polynomial.Polynomial.fit(number, angle, 1, w=np.sqrt(window))
    ahead = math.sqrt(np.average((angle - line(number)) ** 2, weights=window))
    return PHASE / ahead if ahead > 0.0 else math.inf


def speed_remarks(signal: Signal, spectrum: MeshSpectrum, count: int) -> Iterator[str]:
    """A line if the speed reverses, or varies so much that some of the highest lines are too low.

    Args:
        signal: of a mesh or a sensor; an angle that is constant states no speed.
        spectrum: of this signal over frequency.
        count: number of lines that are listed.
    """
    if not signal.has_mean_speed:
        yield (
            f"the mean speed of the sun relative to the carrier, {signal.speed:.3g} rad/s, is less "
            f"than {MEAN:g} times its rms, {signal.rms_speed:.3g} rad/s: there is no mesh "
            "frequency and no line is named; select an interval without reversal or rest by --from "
            "and --to"
        )
        return
    frequency = exact_order(signal.angle) * abs(signal.speed) / math.tau
    if any(line.place > frequency for line in spectrum.lines(count)):
        yield (
            f"the speed varies: lines above {frequency:.3g} Hz that follow it are more than 1 % "
            "too low, and spread; use --order"
        )
