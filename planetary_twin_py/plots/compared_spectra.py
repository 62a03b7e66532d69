"""Spectra of several signals below each other over one axis, with lines named by cause."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..analysis.lines.line_names import NamedLine
from ..analysis.lines.mesh_spectrum import MeshSpectrum
from .style import GREY, applied, panels

DECADES = 4  # shown below the highest line
NAMES = 6  # lines of each signal that are named
LONGEST = 34  # characters of a name
ABOVE = 3.5  # decades above the highest line, for names
HEIGHT = 3.2  # [in] of a panel


class Compared(NamedTuple):
    """One of the signals."""

    spectrum: MeshSpectrum
    title: str
    ordinate: str
    """Label of the amplitudes, with their unit."""
    lines: list[NamedLine]


def compared_spectra(every: list[Compared], axis: str) -> Figure:
    """Draw spectra with the same range of the axis; amplitudes have scales of their own.

    Args:
        every: the signals, in the order of the panels.
        axis: label of the axis.
    """
    low = max(each.spectrum.band.low for each in every)
    high = min(each.spectrum.band.high for each in every)
    with applied():
        figure, drawn = panels(len(every), HEIGHT, columns=1)
        for each, axes in zip(every, drawn, strict=True):
            _panel(axes, each, (low, high))
        drawn[-1].set_xlabel(axis)
    return figure


def _panel(axes: Axes, each: Compared, limits: tuple[float, float]) -> None:
    spectrum = each.spectrum
    seen = (spectrum.axis >= limits[0]) & (spectrum.axis <= limits[1]) & (spectrum.axis > 0.0)
    amplitude = spectrum.amplitude[seen]
    highest = float(amplitude.max(initial=0.0)) or 1.0
    top, bottom = highest * 10.0**ABOVE, highest * 10.0**-DECADES
    axes.semilogy(spectrum.axis[seen], np.maximum(amplitude, bottom), lw=0.8)
    axes.set(xlim=limits, ylim=(bottom, top), ylabel=each.ordinate)
    axes.set_title(each.title, fontsize="medium")
    named = [one for one in each.lines if one.text and limits[0] <= one.line.place <= limits[1]]
    for one in named[:NAMES]:
        text = one.text if len(one.text) <= LONGEST else f"{one.text[: LONGEST - 3]}..."
        axes.plot(*one.line, ".", color=GREY, ms=4)
        axes.annotate(
            text,
            one.line,
            (0, 3),
            textcoords="offset points",
            rotation=90,
            ha="center",
            va="bottom",
            fontsize=5,
            color=GREY,
        )
