"""Temperatures of oil, gears and housing over time."""

from __future__ import annotations

from collections.abc import Sequence

import rerun.blueprint as rrb

from ..recording.ros2.sensor_message import CELSIUS
from ..recording.runs.slow_states import SlowStates, ThermalStates
from . import timeline
from .layer import Colour, Layer
from .plots import log_series, mesh_colours

CURVES = "temperatures"
HOTTEST_CURVES, FILM_CURVES = "contact_temperatures", "specific_films"
_COLOURS: tuple[Colour, ...] = (
    (214, 180, 92),
    (236, 120, 64),
    (120, 170, 236),
    (205, 104, 86),
    (150, 158, 170),
    (96, 200, 150),
)


def log_temperatures(layer: Layer, thermal: ThermalStates) -> None:
    """Log the temperatures of all parts [degC], and the extremes of the meshes in each period.

    Args:
        layer: layer to draw into.
        thermal: temperatures and extremes over time.
    """
    _log(layer, CURVES, _celsius(thermal.temperatures), _COLOURS)
    if thermal.hottest is not None:
        for path, states in (
            (HOTTEST_CURVES, _celsius(thermal.hottest)),
            (FILM_CURVES, thermal.thinnest),
        ):
            if states is not None:
                _log(layer, path, states, mesh_colours(len(states.names) // 2))


def _log(layer: Layer, path: str, states: SlowStates, colours: Sequence[Colour]) -> None:
    index = timeline.columns(states.time, states.stamp)
    log_series(layer, path, index, states.values, states.names, colours)


def _celsius(states: SlowStates) -> SlowStates:
    return states._replace(values=states.values - CELSIUS)


def temperature_page(thermal: ThermalStates) -> rrb.Vertical:
    """The page with their curves.

    Args:
        thermal: temperatures and extremes over time.
    """
    titles = {CURVES: "Temperatures [degC]"}
    if thermal.hottest is not None:
        titles |= {
            HOTTEST_CURVES: "Highest contact temperature (Blok) [degC]",
            FILM_CURVES: "Smallest specific film [-]",
        }
    legend = rrb.PlotLegend(rrb.Corner2D.LeftTop)
    views = [
        rrb.TimeSeriesView(origin=path, name=title, plot_legend=legend)
        for path, title in titles.items()
    ]
    return rrb.Vertical(*views, name="Temperatures")
