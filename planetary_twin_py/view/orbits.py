"""Orbits of sun, ring and carrier in the housing, around the time cursor."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..recording.runs.waveform import AxesSamples
from ..units.catalogue import MEMBERS
from .chart import Chart, Strip, send_strips
from .frames import Frames
from .layer import Layer
from .plots import TRAIN_COLOURS

SIZE = (320, 300)  # of a chart
WINDOW = 0.04  # [s] around the time cursor
_MARGIN = 1.08  # of the range, around the orbit
_LEAST = 1e-3  # [um] from the centre to the edge of a chart


def log_orbits(layer: Layer, frames: Frames, samples: AxesSamples) -> None:
    """Log /orbit/BODY, each with its own scale, the same for both directions and all times.

    Args:
        layer: recording to draw into.
        frames: windows around which orbits are drawn.
        samples: displacements of the axes.
    """
    for body, name in enumerate(MEMBERS):
        orbit = 1e6 * samples.orbit[:, body].astype(np.float64)
        reach = max(_MARGIN * float(np.abs(orbit).max()), _LEAST)
        ends = -reach, reach
        chart = Chart(
            f"orbit/{name}", SIZE, xlim=ends, ylim=ends, aspect="equal", xlabel="x", ylabel="y"
        )
        chart.log(layer)
        strips = _strips(chart, frames, samples.time, orbit)
        send_strips(layer, f"orbit/{name}/curve", frames.index, strips, TRAIN_COLOURS[body], 2.4)


def _strips(
    chart: Chart, frames: Frames, time: NDArray[np.float64], orbit: NDArray[np.float64]
) -> list[list[Strip]]:
    """The part of an orbit around each frame."""
    strips = []
    for now in frames.time:
        begin, end = np.searchsorted(time, (now - 0.5 * WINDOW, now + 0.5 * WINDOW))
        part = orbit[begin:end]
        strips.append([chart.place(*part.T)] if len(part) > 1 else [])
    return strips
