"""Rows of a table that compares measurements of a gearbox with its simulation."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from planetary_twin_msgs.msg import FollowerEstimate, FollowerEvent, GearboxState

Row = tuple[str, str, str, str]


class Pair(NamedTuple):
    """A measured quantity and its simulated value."""

    title: str
    unit: str
    measured: float
    simulated: float

    @property
    def residual(self) -> float:
        """Measured minus simulated value."""
        return self.measured - self.simulated


def pairs(estimate: FollowerEstimate, state: GearboxState) -> list[Pair]:
    """Return torque, speed and loss of a gearbox and of its twin, in SI."""
    loss = estimate.loss_torque * abs(estimate.input_speed)
    return [
        Pair("Input torque, measured", "N m", estimate.input_torque, state.input_torque),
        Pair("Input speed, measured", "rad/s", estimate.input_speed, state.input_speed),
        Pair("Power loss, measured", "W", loss, state.power_loss),
    ]


def beside_rows(
    estimate: FollowerEstimate, state: GearboxState, events: Iterable[FollowerEvent]
) -> Iterator[Row]:
    """Yield title, value, unit and remark: simulated value and residual, then changes."""
    for pair in pairs(estimate, state):
        beside = f"twin {pair.simulated:.5g}, residual {pair.residual:+.3g}"
        known = math.isfinite(pair.measured)
        yield pair.title, _shown(pair.measured), pair.unit, beside if known else ""
    span = f"{estimate.friction_level_low:.3g} to {estimate.friction_level_high:.3g}"
    level = estimate.friction_level
    remark = span if math.isfinite(level) else estimate.friction_level_status.replace("_", " ")
    yield "Friction level", _shown(level), "", remark
    for event in events:
        yield "Change", "", "", f"{event.what}: {event.evidence}"


def _shown(value: float) -> str:
    return f"{value:.5g}" if math.isfinite(value) else "-"
