"""Marks points at which viscous friction is clipped to zero, so that losses are underestimated."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes

from ..studies.doubts import THRESHOLD
from ..units.catalogue import CLIPPED, SIDES
from .quantity import Column

LEGEND = "hollow: viscous friction is clipped to zero part of the time"


def clipped_points(
    known: Mapping[str, Column], count: int, sides: Sequence[str] = SIDES
) -> np.ndarray:
    """Points at which viscous friction is clipped in a mesh of `sides`.

    Args:
        known: columns of the table by name.
        count: number of rows.
        sides: kinds of mesh.

    Returns:
        Booleans, shape (count,); all False if the table lacks the columns.
    """
    names = [f"{side}_{CLIPPED}" for side in sides]
    clipped = [known[name].values > THRESHOLD for name in names if name in known]
    return np.any(clipped, axis=0) if clipped else np.full(count, False)


def mark(axes: Axes, x: np.ndarray, y: np.ndarray, colour: str) -> None:
    """Draw hollow points at `x`, `y` (n,) in `colour`.

    Args:
        axes: where to draw.
        x: coordinates, (n,).
        y: coordinates, (n,).
        colour: colour of the points.
    """
    if len(x):
        look = axes.scatter(x, y, s=9.0, zorder=3, clip_on=False)
        look.set(facecolor="white", edgecolor=colour, linewidth=0.9)
