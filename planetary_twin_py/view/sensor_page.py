"""Page of a sensor: its samples, and its spectra at the time cursor."""

from __future__ import annotations

import rerun.blueprint as rrb

from .chart import BACKGROUND, bounds
from .sensor_spectra import BAND, KINDS, SIZE
from .sensors import Shown
from .timeline import SIMULATED_TIME

_ZOOM = 50_000_000  # [ns] of the samples on either side of the time cursor


def sensor_page(shown: Shown) -> rrb.Vertical:
    """Make the page of a sensor.

    Args:
        shown: the sensor.
    """
    unit, rate = shown.channel.unit, shown.channel.sensor.rate
    low, high = (share * rate for share in BAND)
    notes = {
        "spectrum": f" at the time cursor: amplitude [{unit}]",
        "order_spectrum": f" at the time cursor: amplitude [{unit}]",
        "envelope_spectrum": f" of the band from {low:g} to {high:g} Hz [({unit})^2]",
    }
    charts = [
        rrb.Spatial2DView(
            origin=f"{shown.path}/{kind.name}",
            name=f"{kind.title}{notes[kind.name]}",
            visual_bounds=bounds(SIZE),
            background=BACKGROUND,
        )
        for kind in KINDS
        if shown.of_twin or kind.name != "order_spectrum"
    ]
    return rrb.Vertical(_samples(shown), _range(shown), *charts, name=shown.name)


def _samples(shown: Shown) -> rrb.TimeSeriesView:
    window = rrb.VisibleTimeRange(
        SIMULATED_TIME,
        start=rrb.TimeRangeBoundary.cursor_relative(nanos=-_ZOOM),
        end=rrb.TimeRangeBoundary.cursor_relative(nanos=_ZOOM),
    )
    return rrb.TimeSeriesView(
        origin=f"{shown.path}/waveform",
        name=f"{shown.name} around the time cursor, every sample [{shown.channel.unit}]",
        plot_legend=rrb.PlotLegend(rrb.Corner2D.RightTop, visible=False),
        time_ranges=window,
        axis_x=rrb.TimeAxis(link="Independent", view_range=window.range),
    )


def _range(shown: Shown) -> rrb.TimeSeriesView:
    return rrb.TimeSeriesView(
        origin=f"{shown.path}/range",
        name=f"{shown.name}, smallest and largest sample [{shown.channel.unit}]",
        plot_legend=rrb.PlotLegend(rrb.Corner2D.RightTop, visible=False),
    )
