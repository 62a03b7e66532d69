"""A measure over two fields as filled contours."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from .quantity import Column
from .style import GREY, logarithmic

COLOURS = "viridis"
LEVELS = 12


def draw_map(
    axes: Axes,
    fields: tuple[Column, Column, Column],
    rows: np.ndarray,
    limits: tuple[float, float],
) -> None:
    """Draw filled contours; a missing point of a grid is a hole, scattered points are triangulated.

    Args:
        axes: where to draw.
        fields: columns of the horizontal axis, of the vertical axis and of the colour.
        rows: rows to draw (bool).
        limits: limits of the colours.
    """
    x, y, z = (column.values[rows] for column in fields)
    levels = MaxNLocator(LEVELS).tick_values(*limits)
    grid = _grid(x, y, z)
    coordinates: Any = grid or (x, y, z)
    fill: Any = axes.contourf if grid else axes.tricontourf
    draw: Any = axes.contour if grid else axes.tricontour
    filled = fill(*coordinates, levels=levels, cmap=COLOURS)
    lines = draw(*coordinates, levels=levels, colors="white", linewidths=0.5)
    axes.clabel(lines, fontsize=7.5)
    axes.plot(x, y, ".", color=GREY, markersize=2.0, clip_on=False)
    axes.figure.colorbar(filled, ax=axes, label=fields[2].label)
    axes.set(xlabel=fields[0].label, ylabel=fields[1].label)
    if fields[0].is_logarithmic:
        logarithmic(axes, "x")
    if fields[1].is_logarithmic:
        logarithmic(axes, "y")


def _grid(
    x: np.ndarray, y: np.ndarray, z: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
    """Axes and masked values (y, x) of a grid; None for scattered points."""
    across, column = np.unique(x, return_inverse=True)
    up, row = np.unique(y, return_inverse=True)
    if len(across) * len(up) > 2 * len(z):
        return None
    values = np.full((len(up), len(across)), np.nan)
    values[row, column] = z
    return across, up, np.ma.masked_invalid(values)
