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

from ...recording.tables.speed_faults import SpeedColumn
from ..sampling.even_steps import PHASE
from ..signals.signal import MEAN, Array, Signal
from ..spectra.spectrum import Line
from .mesh_spectrum import MeshSpectrum

SMALL = 0.01  # of the highest line, below which a line may be noise
SHARP = 1.1  # power near a line over that of a tone, above which the line is spread
NEAR = 8  # bins on each side of a line
HANN = 1.5  # [bins] equivalent noise bandwidth of a Hann window (Harris 1978, table 1)


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


def unused_speed_remarks(
    column: SpeedColumn, signal: Signal, spectrum: MeshSpectrum, hertz: float, count: int
) -> Iterator[str]:
    """A line if a speed that is not used varies so much that lines which follow it are too low.

    A sharp line does not follow it, such as one of the mains.

    Args:
        column: measured speed at the samples of the signal.
        signal: of a sensor.
        spectrum: of this signal.
        hertz: frequency over place on the axis of the spectrum.
        count: number of lines that are listed.
    """
    turned = cumulative_trapezoid(column.values, dx=1.0 / signal.sample_rate, initial=0)
    mean = abs(float(turned[-1])) * signal.sample_rate / (len(turned) - 1)
    frequency = exact_order(turned) * mean / math.tau  # in any unit of the speed
    lines = spectrum.lines(count)
    high = [line for line in lines if line.amplitude > SMALL * lines[0].amplitude]
    if any(hertz * line.place > frequency and _spread(spectrum, line) > SHARP for line in high):
        span = f"{column.values.min():.6g} to {column.values.max():.6g}"
        yield (
            f"the column {column.heading!r} varies from {span}: lines above "
            f"{frequency:.3g} Hz that follow it are more than 1 % too low, and spread; use "
            f"--speed {column.name} --order if it is the speed of the input shaft"
        )


def _spread(spectrum: MeshSpectrum, line: Line) -> float:
    """Power near a line over that of a tone of its height; 1 for a tone."""
    middle = round(line.place / float(spectrum.axis[1]))
    near = spectrum.amplitude[max(middle - NEAR, 1) : middle + NEAR + 1]
    return float((near**2).sum()) / (HANN * line.amplitude**2)


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
