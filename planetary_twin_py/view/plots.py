"""Curves of the fields of GearboxState, per mesh and for the whole train."""

from __future__ import annotations

import colorsys
from collections.abc import Sequence

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from ..recording.runs.reader import Recording
from ..units.catalogue import BEARING, MEMBERS, MESH, TRAIN_PLOTS
from . import timeline
from .layer import Colour, Layer

_SUN_PLANET_HUE, _PLANET_RING_HUE = 0.58, 0.09  # blue and orange
PLOTTED_OF_AXES = ("displacement_peak", "bearing_force_peak")
TRAIN_COLOURS = ((236, 176, 64), (150, 158, 170), (205, 104, 86))


def log_plots(layer: Layer, recording: Recording) -> None:
    """Log every quantity of the state: /mesh/NAME with one series per mesh, and /train/NAME.

    Args:
        layer: recording to draw into.
        recording: recording to draw.
    """
    state = recording.state
    index = timeline.columns(state.time, state.stamp)
    colours = mesh_colours(recording.planets)
    for name, quantity in MESH.items():
        values = quantity.factor * recording.per_mesh(name)
        log_series(layer, f"mesh/{name}", index, values, recording.meshes, colours)
    for name, (quantity, fields) in TRAIN_PLOTS.items():
        values = quantity.factor * np.column_stack([state[field] for field in fields])
        log_series(layer, f"train/{name}", index, values, fields, TRAIN_COLOURS)


def log_plots_of_axes(layer: Layer, recording: Recording) -> None:
    """Log the state of axes that move: /axes/NAME with one series per planet or body.

    Args:
        layer: recording to draw into.
        recording: recording to draw.
    """
    axes, planets = recording.axes_state, recording.planets
    if not len(axes):
        return
    index = timeline.columns(axes.time, axes.stamp)
    numbered = [f"planet_{i + 1}" for i in range(planets)]
    colours = mesh_colours(planets)[:planets]
    shares = axes["load_share"][:, :planets]
    log_series(layer, "axes/load_share", index, shares, numbered, colours)
    for name in PLOTTED_OF_AXES:
        members = [axes[f"{member}_{name}"] for member in MEMBERS]
        of_planets = axes[f"planet_{name}"][:, :planets]
        values = BEARING[name].factor * np.column_stack([*members, of_planets])
        names = [*MEMBERS, *numbered]
        log_series(layer, f"axes/{name}", index, values, names, [*TRAIN_COLOURS, *colours])


def log_series(
    layer: Layer,
    path: str,
    index: list[rr.TimeColumn],
    values: NDArray[np.float64],
    names: Sequence[str],
    colours: Sequence[Colour],
) -> None:
    """Log `values` (rows, series) as lines at `path`.

    Args:
        layer: recording to draw into.
        path: path of the entity.
        index: time columns, n rows.
        values: (n, series).
        names: names of the series.
        colours: colours of the series.
    """
    layer.log(path, layer.lines(names, colours), static=True)
    layer.send_columns(path, index, rr.Scalars.columns(scalars=values))


def mesh_colours(planets: int) -> list[Colour]:
    """Shades of blue for the sun meshes, then of orange for the ring meshes."""
    shades = np.linspace(0.78, 0.3, planets)
    tints = [
        colorsys.hsv_to_rgb(hue, shade, 0.95)
        for hue in (_SUN_PLANET_HUE, _PLANET_RING_HUE)
        for shade in shades
    ]
    return [(round(255 * red), round(255 * green), round(255 * blue)) for red, green, blue in tints]
