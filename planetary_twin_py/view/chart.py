"""Charts with an axis other than time: axes drawn once by Matplotlib, and curves that move on them.

The plots of Rerun have a time axis. A chart is a picture in a plane, and its curves are line strips
in the pixels of this picture, x to the right and y downwards from its upper left corner.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from contextlib import AbstractContextManager
from typing import Any

import matplotlib.style
import numpy as np
import rerun as rr
import rerun.blueprint as rrb
from matplotlib.figure import Figure
from numpy.typing import ArrayLike, NDArray

from .layer import Layer

Strip = NDArray[np.float32]
SHADES = "plasma"
"""Colour map of amplitudes and loads, from a dark violet to yellow."""
BACKGROUND = (13, 16, 17)  # of the plots of Rerun
_TEXT = (205, 210, 218)
_INCH = 100  # pixels of the screen, for the size of texts
_FINER = 2  # pixels of the picture per pixel of the screen
_STYLE: Any = ("dark_background", {
    "figure.facecolor": [channel / 255 for channel in BACKGROUND], "axes.facecolor": "none",
    "axes.grid": True, "grid.color": "#2c3037", "axes.edgecolor": "#787e88", "font.size": 8.5,
})  # fmt: skip


def dark() -> AbstractContextManager[None]:
    """Context in which parts of a chart are drawn in its colours."""
    return matplotlib.style.context(_STYLE)


class Chart:
    """Axes of Matplotlib.

    Args:
        path: parent of the entities of the chart.
        size: width and height [pixels of the screen].
        properties: of the axes, see `matplotlib.axes.Axes.set`.
    """

    def __init__(self, path: str, size: tuple[int, int], **properties: Any) -> None:
        self.path = path
        self._size = size
        inches = size[0] / _INCH, size[1] / _INCH
        with dark():
            self.figure = Figure(inches, _INCH * _FINER, layout="constrained")
            self.axes = self.figure.add_subplot(**properties)

    def log(self, layer: Layer) -> None:
        """Log the picture at PATH/picture; curves are placed on it afterwards.

        Args:
            layer: recording to draw into.
        """
        png = io.BytesIO()
        self.figure.savefig(png, format="png")
        picture = rr.EncodedImage(contents=png.getvalue(), media_type="image/png", draw_order=-20.0)
        layer.log(f"{self.path}/picture", picture, static=True)

    def place(self, x: ArrayLike, y: ArrayLike) -> Strip:
        """Points in the plane, clipped to the axes, (n, 2).

        Args:
            x: coordinates in units of the axis, (n,).
            y: coordinates in units of the axis, (n,).
        """
        inside = np.clip(x, *self.axes.get_xlim()), np.clip(y, *self.axes.get_ylim())
        across, up = self.axes.transData.transform(np.column_stack(inside)).T
        return np.column_stack((across, self.figure.bbox.height - up)).astype(np.float32)

    def upright(self, x: float) -> Strip:
        """A line from bottom to top at `x`, (2, 2)."""
        return self.place([x, x], self.axes.get_ylim())


def bounds(size: tuple[int, int]) -> rrb.VisualBounds2D:
    """The region of a picture.

    Args:
        size: width and height of the chart [pixels of the screen].
    """
    across, down = (rr.encodings.Range1D((0.0, _FINER * length)) for length in size)
    return rrb.VisualBounds2D(x_range=across, y_range=down)


def send_strips(
    layer: Layer,
    path: str,
    index: list[rr.TimeColumn],
    rows: Sequence[Sequence[Strip]],
    colour: tuple[int, int, int],
    width: float = 1.2,
) -> None:
    """Send line strips over time.

    Args:
        layer: recording to draw into.
        path: path of the entity.
        index: time columns, n rows.
        rows: n lists of strips (points, 2).
        colour: of the lines.
        width: of the lines [pixels of the screen].
    """
    radii = [-0.5 * width]  # a negative one counts in pixels of the screen
    layer.log(path, rr.LineStrips2D.from_fields(colors=[colour], radii=radii), static=True)
    strips = [strip for row in rows for strip in row]
    columns = rr.LineStrips2D.columns(strips=strips).partition([len(row) for row in rows])
    layer.send_columns(path, index, columns)


def send_labels(
    layer: Layer,
    path: str,
    index: list[rr.TimeColumn],
    rows: Sequence[Sequence[tuple[Strip, str]]],
) -> None:
    """Send labels over time.

    Args:
        layer: recording to draw into.
        path: path of the entity.
        index: time columns, n rows.
        rows: n lists of labels, each a point (2,) and the text below it.
    """
    style = rr.Points2D.from_fields(colors=[_TEXT], radii=[0.0], show_labels=True)
    layer.log(path, style, static=True)
    labels = [label for row in rows for label in row]
    columns = rr.Points2D.columns(
        positions=np.array([place for place, _ in labels], np.float32).reshape(-1, 2),
        labels=[text for _, text in labels],
    ).partition([len(row) for row in rows])
    layer.send_columns(path, index, columns)
