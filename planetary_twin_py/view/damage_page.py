"""Damage of the parts of a gearbox: a bar for each at the time cursor, and curves over time."""

from __future__ import annotations

import rerun as rr
import rerun.blueprint as rrb

from ..recording.runs.slow_states import SlowStates
from . import timeline
from .layer import Colour, Layer
from .plots import log_series

BARS, CURVES = "damage/bars", "damage/parts"
_GEARS: dict[str, Colour] = {
    "sun": (236, 176, 64), "ring": (205, 104, 86), "planet": (120, 170, 236),
}  # fmt: skip
_OTHERS: Colour = (150, 158, 170)


def log_damage(layer: Layer, damage: SlowStates) -> None:
    """Log the damage of all parts.

    Args:
        layer: layer to draw into.
        damage: Miner sums of the parts over time.
    """
    index = timeline.columns(damage.time, damage.stamp)
    colours = [_colour(part) for part in damage.names]
    log_series(layer, CURVES, index, damage.values, damage.names, colours)
    for n, sums in enumerate(damage.values):  # a column takes bars of one time only
        now = timeline.columns(damage.time[n : n + 1], damage.stamp[n : n + 1])
        layer.send_columns(BARS, now, rr.BarChart.columns(values=sums))


def damage_page(parts: tuple[str, ...]) -> rrb.Vertical:
    """The page with bars and curves."""
    order = ", ".join(f"{n} {part}" for n, part in enumerate(parts))
    return rrb.Vertical(
        rrb.BarChartView(origin=BARS, name=f"Damage at the time cursor: {order}"),
        rrb.TimeSeriesView(
            origin=CURVES,
            name="Damage of the parts: Miner sum, failure is expected at 1",
            plot_legend=rrb.PlotLegend(rrb.Corner2D.LeftTop),
        ),
        name="Damage",
    )


def _colour(part: str) -> Colour:
    own = (colour for gear, colour in _GEARS.items() if part.startswith(gear))
    return _OTHERS if part.endswith("_bearing") else next(own, _OTHERS)
