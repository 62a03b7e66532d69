"""Figures of a sampled study: a measure over each field, and distributions of measures."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import fill

import numpy as np
from matplotlib.figure import Figure

from ..studies.distribution import percentiles
from .quantity import Column
from .style import CYCLE, GREY, panels

LABEL = 34  # characters per line of the label of a vertical axis


def points_diagram(fields: Sequence[Column], measures: Sequence[Column]) -> Figure:
    """Draw the points of each measure over each field, whatever the other fields are.

    Args:
        fields: columns of the horizontal axes.
        measures: columns of the vertical axes, a row each.
    """
    figure, panes = panels(len(fields) * len(measures), 2.9, min(len(fields), 3))
    places = [(measure, field) for measure in measures for field in fields]
    for axes, (measure, field) in zip(panes, places, strict=True):
        axes.plot(field.values, measure.values, "o", markersize=3.0, color=CYCLE[0], alpha=0.6)
        axes.set_xlabel(fill(field.label, LABEL))
        axes.set_ylabel(fill(measure.label, LABEL))
    return figure


def histogram_diagram(measures: Sequence[Column]) -> Figure:
    """Draw how often the values of each measure occur, with percentiles.

    Args:
        measures: numerical columns, a panel each.
    """
    figure, panes = panels(len(measures), 2.9, min(len(measures), 2))
    for axes, measure in zip(panes, measures, strict=True):
        values = measure.values[np.isfinite(measure.values)]
        axes.hist(values, bins="auto", color=CYCLE[0])
        for share, value in percentiles(values).items():
            axes.axvline(value, color=GREY, linewidth=0.8)
            axes.annotate(
                f"{share:g} %", (value, 1.0), xycoords=axes.get_xaxis_transform(), color=GREY,
                ha="center", va="bottom", fontsize="small",
            )  # fmt: skip
        axes.set_xlabel(fill(measure.label, LABEL))
        axes.set_ylabel("points")
    return figure
