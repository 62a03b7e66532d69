"""Spectrum of a mesh: amplitudes on a logarithmic scale, with mesh harmonics marked."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.figure import Figure

from ..analysis.lines.mesh_spectrum import MeshSpectrum
from .style import GREY, WIDTH, applied, panels

DECADES = 5  # shown below the highest line
HARMONICS = 30  # marked at most, so that the marks do not hide the curve
LABEL_WIDTH = 0.3  # [in] of the number of a harmonic


def spectrum_plot(spectrum: MeshSpectrum, title: str, labels: tuple[str, str]) -> Figure:
    """Draw a spectrum in its band, without the mean.

    Args:
        spectrum: amplitudes.
        title: title of the figure.
        labels: labels of both axes, with their units.
    """
    with applied():
        figure, (axes,) = panels(height=3.6)
        seen = spectrum.in_band & (spectrum.axis > 0.0)
        axis, amplitude = spectrum.axis[seen], spectrum.amplitude[seen]
        top = 2.0 * float(amplitude.max()) or 1.0
        low = top * 10.0**-DECADES
        axes.semilogy(axis, np.maximum(amplitude, 0.1 * low), lw=0.9)
        axes.set(xlim=spectrum.band, ylim=(low, top), xlabel=labels[0], ylabel=labels[1])
        axes.set_title(f"{title}\n")
        mesh = spectrum.mesh or np.inf
        first = max(math.ceil(spectrum.band.low / mesh), 1)
        last = min(math.floor(spectrum.band.high / mesh), first + HARMONICS - 1)
        apart = WIDTH * mesh / (spectrum.band.high - spectrum.band.low)
        every = math.ceil(LABEL_WIDTH / apart)
        for harmonic in range(first, last + 1):
            axes.axvline(harmonic * mesh, color=GREY, lw=0.5, zorder=0)
            if harmonic % every == 0:
                place = (harmonic * mesh, top)
                axes.annotate(
                    f"{harmonic}",
                    place,
                    (0, 2),
                    textcoords="offset points",
                    color=GREY,
                    ha="center",
                )
    return figure
