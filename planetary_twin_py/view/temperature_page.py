"""Temperatures of oil, gears and housing over time."""

from __future__ import annotations

import rerun.blueprint as rrb

from ..recording.ros2.sensor_messages import CELSIUS
from ..recording.runs.slow_states import SlowStates
from . import timeline
from .layer import Colour, Layer
from .plots import log_series

CURVES = "temperatures"
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


def temperature_page() -> rrb.TimeSeriesView:
    """The page with their curves."""
    return rrb.TimeSeriesView(
        origin=CURVES,
        name="Temperatures [degC]",
        plot_legend=rrb.PlotLegend(rrb.Corner2D.LeftTop),
    )
