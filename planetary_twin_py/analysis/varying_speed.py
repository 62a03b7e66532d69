"""How far a varying speed lowers the lines of a spectrum over frequency.

A shaft that is ahead of its mean speed by the angle d turns a line of order N by the phase N d. The
line loses the share P^2/2 of its height, where P is the rms of these phases with the weights of the
window.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from scipy.integrate import cumulative_trapezoid
from scipy.signal import get_window

from ..recording.tables.sensor import SpeedColumn
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


def unused_speed_remarks(column: SpeedColumn, rate: float, highest: float) -> Iterator[str]:
    """A line if a speed that is not used varies so much that the highest line is too low.

    Args:
        column: measured speed at the samples of the signal.
        rate: sample rate [Hz].
        highest: frequency of the highest of the listed lines [Hz].
    """
    turned = cumulative_trapezoid(column.values, dx=1.0 / rate, initial=0)
    mean = abs(float(turned[-1])) * rate / (len(turned) - 1)
    frequency = exact_order(turned) * mean / math.tau  # in any unit of the speed
    if highest > frequency:
        low, high = float(column.values.min()), float(column.values.max())
        yield (
            f"the column {column.heading!r} varies from {low:.6g} to {high:.6g}: lines above "
            f"{frequency:.3g} Hz that follow it are more than 1 % too low, and spread; use "
            f"--speed {column.name} --order if it is the speed of the input shaft"
        )


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
