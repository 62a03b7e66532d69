"""Marks points at which viscous friction is clipped to zero: their loss comes out too low."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes

from ..studies.clipping import TOLD
from ..studies.measures import CLIPPED, SIDES
from .quantity import Column

LEGEND = "hollow: viscous friction is clipped to zero for a time"


def clipped_points(
    known: Mapping[str, Column], count: int, sides: Sequence[str] = SIDES
) -> np.ndarray:
    """Which of `count` rows are concerned in a mesh of `sides`; none of a table without shares."""
    names = [f"{side}_{CLIPPED}" for side in sides]
    told = [known[name].values > TOLD for name in names if name in known]
    return np.any(told, axis=0) if told else np.full(count, False)


def mark(axes: Axes, x: np.ndarray, y: np.ndarray, colour: str) -> None:
    """Draw points hollow."""
    if len(x):
        look = axes.scatter(x, y, s=9.0, zorder=3, clip_on=False)
        look.set(facecolor="white", edgecolor=colour, linewidth=0.9)
