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
from .chart import Chart, Strip, send_labels, send_strips
from .frames import Frames
from .layer import Layer
from .plots import mesh_colours

Array = NDArray[np.float64]
SIZE = (520, 300)
WINDOW, CYCLES = 0.04, 4  # [s], or mesh cycles if slower
FINER = 3  # points of the curve per sample, for a smooth curve
MOST_POINTS = 6000
_FLANK = (236, 176, 64)
_MARGIN = 0.06  # of the range, around the curve
_ROOM = 1.12  # height of the axes over that of the curve, with room for the range in words


class _Portrait(NamedTuple):
    """What is drawn of a window."""

    curve: list[Strip]
    flanks: list[Strip]
    ranges: list[tuple[Strip, str]]


def log_phase_portrait(layer: Layer, frames: Frames, scene: Scene | None) -> None:
    """Log /phase_portrait, in which the curve of every window fills the axes.

    Args:
        layer: recording to draw into.
        frames: windows of the DTE.
        scene: whose law of backlash places the flanks; None: they are not marked.
    """
    axes = {"xticks": [], "yticks": [], "xlabel": "DTE", "ylabel": "rate", "ylim": (0.0, _ROOM)}
    chart = Chart("phase_portrait", SIZE, **axes)
    chart.log(layer)
    point = frames.recording.operating_point
    rows = np.searchsorted(point.time, frames.time, side="right") - 1
    backlash = [float(point["backlash"][row]) if row >= 0 else math.nan for row in rows]
    meet = [math.nan if scene is None else flanks_meet(scene, each) for each in backlash]
    drawn = [_portrait(chart, frames, number, at) for number, at in enumerate(meet)]
    index, colour = frames.index, mesh_colours(frames.recording.planets)[0]
    send_strips(layer, "phase_portrait/flanks", index, [one.flanks for one in drawn], _FLANK)
    send_strips(layer, "phase_portrait/curve", index, [one.curve for one in drawn], colour)
    send_labels(layer, "phase_portrait/range", index, [one.ranges for one in drawn])


def flanks_meet(scene: Scene, backlash: float) -> float:
    """Magnitude of the transmission error at which flanks meet [m].

    Args:
        scene: whose law of backlash is used.
        backlash: of the operating point [m].
    """
    meet, _ = scene.mesh.flanks(backlash, scene.gearset.transverse.pressure_angle)
    return meet


def _portrait(chart: Chart, frames: Frames, number: int, meet: float) -> _Portrait:
    """Portrait of a window, empty if samples are missing; flanks meet at `meet` [m]."""
    window = frames.window(number, frames.lasting(WINDOW, CYCLES))
    if window is None:
        return _Portrait([], [], [])
    time, dte = window
    spline = CubicSpline(time, dte)
    fine = np.linspace(time[0], time[-1], min(FINER * len(time), MOST_POINTS))
    x, y = 1e6 * spline(fine), 1e3 * spline(fine, 1)
    flanks = _on_axis(1e6 * np.array([-meet, meet]), x)
    return _Portrait(
        [chart.place(_on_axis(x, x), _on_axis(y, y))],
        [chart.upright(at) for at in flanks if 0.0 < at < 1.0],
        [(chart.place([0.5], [_ROOM])[0], f"{_span(x)} µm, {_span(y)} mm/s")],
    )


def _on_axis(values: Array, curve: Array) -> Array:
    """Places of values on an axis from 0 to 1 that a curve fills."""
    low, high = float(curve.min()), float(curve.max())
    margin = _MARGIN * (high - low) or 1e-6
    return (values - low + margin) / (high - low + 2.0 * margin)


def _span(values: Array) -> str:
    return f"{values.min():.4g} to {values.max():.4g}"
