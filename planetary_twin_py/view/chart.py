"""Charts with an axis other than time, drawn in a plane: frame, ticks and curves.

The plots of Rerun have a time axis. These charts consist of line strips and labelled points, in
units of about a pixel, x to the right and y upwards from the lower left corner of the frame.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import rerun as rr
import rerun.blueprint as rrb
from numpy.typing import NDArray

from .layer import Layer

Array = NDArray[np.float64]
Colour = tuple[int, int, int]
FRAME, GRID, TEXT = (120, 126, 136), (44, 48, 55), (205, 210, 218)
_MARGINS = (64.0, 40.0, 64.0, 34.0)  # left, right, below, above
_LABEL = 12.0  # distance from the frame to a label, and from a point to its text below


@dataclass(frozen=True)
class Chart:
    """A chart at entity `path`, with its size and the ranges of both axes."""

    path: str
    width: float
    height: float
    x: tuple[float, float]
    y: tuple[float, float]

    def place(self, x: Array, y: Array) -> NDArray[np.float32]:
        """Points (n, 2) in the plane, whose second axis points down, clipped to the frame.

        Args:
            x: coordinates in units of the axis, (n,).
            y: coordinates in units of the axis, (n,).
        """
        across = np.clip((x - self.x[0]) / (self.x[1] - self.x[0]), 0.0, 1.0)
        up = np.clip((y - self.y[0]) / (self.y[1] - self.y[0]), 0.0, 1.0)
        return np.column_stack((self.width * across, -self.height * up)).astype(np.float32)

    def upright(self, x: float) -> NDArray[np.float32]:
        """A line from bottom to top at `x`."""
        return self.place(np.array([x, x]), np.array(self.y))

    def level(self, y: float) -> NDArray[np.float32]:
        """A line from left to right at `y`."""
        return self.place(np.array(self.x), np.array([y, y]))


@dataclass(frozen=True)
class Ticks:
    """Positions and labels of ticks on an axis."""

    values: Sequence[float] | Array
    texts: Sequence[str]


def bounds(width: float, height: float) -> rrb.VisualBounds2D:
    """Visible region of a chart: the frame and the labels around it.

    Args:
        width: width of the frame.
        height: height of the frame.
    """
    left, right, below, above = _MARGINS
    return rrb.VisualBounds2D(
        x_range=rr.encodings.Range1D((-left, width + right)),
        y_range=rr.encodings.Range1D((-height - above, below)),
    )


def grid(chart: Chart, x: Ticks, y: Ticks) -> list[NDArray[np.float32]]:
    """Grid lines, then the frame.

    Args:
        chart: the chart.
        x: ticks of the horizontal axis.
        y: ticks of the vertical axis.
    """
    box = np.array([(0, 0), (1, 0), (1, -1), (0, -1), (0, 0)]) * (chart.width, chart.height)
    lines = [chart.upright(value) for value in x.values]
    return [*lines, *(chart.level(value) for value in y.values), box.astype(np.float32)]


def labels(chart: Chart, x: Ticks, y: Ticks) -> tuple[NDArray[np.float32], list[str]]:
    """Positions (n, 2) and texts of the tick labels on both axes.

    Args:
        chart: the chart.
        x: ticks of the horizontal axis.
        y: ticks of the vertical axis.
    """
    below = [(chart.upright(value)[0, 0], 0.4 * _LABEL) for value in x.values]
    beside = [(-2.3 * _LABEL, chart.level(value)[0, 1] - _LABEL) for value in y.values]
    return np.array([*below, *beside], dtype=np.float32), [*x.texts, *y.texts]


def log_frame(layer: Layer, chart: Chart, x: Ticks, y: Ticks, name: str) -> None:
    """Log frame, grid and tick labels as static data, with the `name` of the x axis.

    Args:
        layer: recording to draw into.
        chart: the chart.
        x: ticks of the horizontal axis.
        y: ticks of the vertical axis.
        name: name of the horizontal axis.
    """
    lines = grid(chart, x, y)
    colours = [GRID] * (len(lines) - 1) + [FRAME]
    frame = rr.LineStrips2D(lines, colors=colours, radii=0.5, draw_order=-10.0)
    layer.log(f"{chart.path}/frame", frame, static=True)
    places, texts = labels(chart, x, y)
    places = np.vstack((places, (0.5 * chart.width, 2.5 * _LABEL)))
    layer.log(f"{chart.path}/marks", texts_at(places, [*texts, name]), static=True)


def texts_at(places: NDArray[np.float32], texts: Sequence[str]) -> rr.Points2D:
    """Texts at positions (n, 2) in the plane.

    Args:
        places: positions, (n, 2).
        texts: n texts.
    """
    return rr.Points2D(places, labels=list(texts), colors=TEXT, radii=0.0, show_labels=True)


def send_strips(
    layer: Layer,
    path: str,
    index: list[rr.TimeColumn],
    rows: Sequence[Sequence[NDArray[np.float32]]],
    style: dict[str, Any],
) -> None:
    """Send line strips over time.

    Args:
        layer: recording to draw into.
        path: path of the entity.
        index: time columns, n rows.
        rows: n lists of strips (points, 2).
        style: arguments of `rr.LineStrips2D`.
    """
    layer.log(path, rr.LineStrips2D.from_fields(**style), static=True)
    strips = [strip for row in rows for strip in row]
    columns = rr.LineStrips2D.columns(strips=strips).partition([len(row) for row in rows])
    layer.send_columns(path, index, columns)


def send_labels(
    layer: Layer,
    path: str,
    index: list[rr.TimeColumn],
    rows: Sequence[tuple[NDArray[np.float32], Sequence[str]]],
) -> None:
    """Send labels over time: for each row of `index`, positions (m, 2) and m texts.

    Args:
        layer: recording to draw into.
        path: path of the entity.
        index: time columns, n rows.
        rows: positions (m, 2) and m texts, n times.
    """
    layer.log(
        path,
        rr.Points2D.from_fields(colors=[TEXT], radii=[0.0], show_labels=True),
        static=True,
    )
    places = np.concatenate([np.asarray(place).reshape(-1, 2) for place, _ in rows])
    texts = [text for _, row in rows for text in row]
    columns = rr.Points2D.columns(positions=places, labels=texts).partition(
        [len(row) for _, row in rows]
    )
    layer.send_columns(path, index, columns)
