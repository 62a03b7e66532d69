"""Phase portrait of a mesh around the time cursor: DTE against its rate.

Steady running is a closed loop; teeth that separate cross the backlash, between the marks, at a
nearly constant rate.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from ..scene import Scene
from .chart import GRID, Chart, Ticks, grid, labels, send_labels, send_strips
from .frames import Frames
from .layer import Layer
from .plots import mesh_colours
from .round_numbers import ticks

Array = NDArray[np.float64]
WIDTH, HEIGHT = 420.0, 215.0
WINDOW, CYCLES = 0.04, 4  # [s], or mesh cycles if slower
FINER = 3  # points of the curve per sample, for a smooth curve
MOST_POINTS = 6000
_FLANK = (236, 176, 64)
_MARGIN = 0.06  # of the range, around the curve


class _Portrait(NamedTuple):
    chart: Chart
    curve: NDArray[np.float32]
    flanks: list[NDArray[np.float32]]
    x: Ticks
    y: Ticks


def log_phase_portrait(layer: Layer, frames: Frames, scene: Scene | None) -> None:
    """Log /phase_portrait, with axes scaled to its size.

    Args:
        layer: recording to draw into.
        frames: windows of the DTE.
        scene: whose law of backlash places the flanks; None: they are not marked.
    """
    point = frames.recording.operating_point
    rows = np.searchsorted(point.time, frames.time, side="right") - 1
    backlash = [float(point["backlash"][row]) if row >= 0 else math.nan for row in rows]
    meet = [math.nan if scene is None else flanks_meet(scene, each) for each in backlash]
    portraits = [_portrait(frames, number, meet[number]) for number in range(len(frames.time))]
    index, colour = frames.index, mesh_colours(frames.recording.planets)[0]
    send_strips(
        layer, "phase_portrait/grid", index,
        [grid(p.chart, p.x, p.y) if p else [] for p in portraits],
        {"colors": [GRID], "radii": [0.5], "draw_order": -10.0},
    )  # fmt: skip
    send_strips(
        layer, "phase_portrait/flanks", index, [p.flanks if p else [] for p in portraits],
        {"colors": [_FLANK], "radii": [0.5], "draw_order": -5.0},
    )  # fmt: skip
    send_strips(
        layer, "phase_portrait/curve", index, [[p.curve] if p else [] for p in portraits],
        {"colors": [colour], "radii": [0.5]},
    )  # fmt: skip
    no_labels = np.empty((0, 2), dtype=np.float32)
    marks = [labels(p.chart, p.x, p.y) if p else (no_labels, []) for p in portraits]
    send_labels(layer, "phase_portrait/marks", index, marks)


def flanks_meet(scene: Scene, backlash: float) -> float:
    """Magnitude of the transmission error at which flanks meet [m].

    Args:
        scene: whose law of backlash is used.
        backlash: of the operating point [m].
    """
    meet, _ = scene.mesh.flanks(backlash, scene.gearset.transverse.pressure_angle)
    return meet


def _portrait(frames: Frames, number: int, meet: float) -> _Portrait | None:
    window = frames.window(number, frames.lasting(WINDOW, CYCLES))
    if window is None:
        return None
    time, dte = window
    spline = CubicSpline(time, dte)
    fine = np.linspace(time[0], time[-1], min(FINER * len(time), MOST_POINTS))
    x, y = 1e6 * spline(fine), 1e3 * spline(fine, 1)
    chart = Chart("phase_portrait", WIDTH, HEIGHT, _range(x), _range(y))
    flanks = [1e6 * side * meet for side in (-1.0, 1.0)]
    return _Portrait(
        chart,
        chart.place(x, y),
        [chart.upright(at) for at in flanks if chart.x[0] < at < chart.x[1]],
        _marks(chart.x),
        _marks(chart.y),
    )


def _range(values: Array) -> tuple[float, float]:
    low, high = float(values.min()), float(values.max())
    margin = _MARGIN * (high - low) or 1e-6
    return low - margin, high + margin


def _marks(ends: tuple[float, float]) -> Ticks:
    values = ticks(*ends, 5)
    return Ticks(values, [f"{value:.6g}" for value in values])
