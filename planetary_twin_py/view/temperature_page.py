"""Temperatures of oil, gears and housing over time."""

from __future__ import annotations

import rerun.blueprint as rrb

from ..recording.ros2.sensor_message import CELSIUS
from ..recording.runs.slow_states import SlowStates
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


def log_temperatures(layer: Layer, temperatures: SlowStates) -> None:
    """Log the temperatures of all parts [degC].

    Args:
        layer: layer to draw into.
        temperatures: temperatures over time [K].
    """
    index = timeline.columns(temperatures.time, temperatures.stamp)
    values = temperatures.values - CELSIUS
    log_series(layer, CURVES, index, values, temperatures.names, _COLOURS)


def log_extremes(layer: Layer, hottest: SlowStates, thinnest: SlowStates | None) -> None:
    """Log the extremes of the meshes in each period.

    Args:
        layer: layer to draw into.
        hottest: highest contact temperatures [K].
        thinnest: smallest specific films [-]; None where they are prescribed.
    """
    celsius = hottest._replace(values=hottest.values - CELSIUS)
    for path, states in ((HOTTEST_CURVES, celsius), (FILM_CURVES, thinnest)):
        if states is not None:
            index = timeline.columns(states.time, states.stamp)
            colours = mesh_colours(len(states.names) // 2)
            log_series(layer, path, index, states.values, states.names, colours)


def temperature_page(extremes: bool) -> rrb.Vertical:
    """The page with their curves.

    Args:
        extremes: whether there are contact temperatures.
    """
    titles = {CURVES: "Temperatures [degC]"}
    if extremes:
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
