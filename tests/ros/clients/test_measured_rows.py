"""What is measured beside what is simulated, in the table of `monitor`."""

from __future__ import annotations

import math

from planetary_twin.clients.monitor import beside_rows, pairs
from planetary_twin_msgs.msg import FollowerEstimate, FollowerEvent, GearboxState


def estimate() -> FollowerEstimate:
    return FollowerEstimate(
        input_torque=62.5, input_speed=-104.0, loss_torque=0.75, friction_level=1.1,
        friction_level_low=0.9, friction_level_high=1.3,
    )  # fmt: skip


def test_residuals_are_measured_less_simulated():
    state = GearboxState(input_torque=63.0, input_speed=-104.0, power_loss=70.0)
    torque, speed, loss = pairs(estimate(), state)
    assert torque.residual == -0.5 and speed.residual == 0.0
    assert loss.measured == 78.0 and loss.residual == 8.0


def test_what_is_not_identifiable_is_named():
    unknown = estimate()
    unknown.friction_level, unknown.loss_torque = math.nan, math.nan
    unknown.friction_level_status = "NOT_IDENTIFIABLE"
    event = FollowerEvent(what="sun tooth 7 changed", evidence="z = 13.0")
    rows = {row[0]: row for row in beside_rows(unknown, GearboxState(), [event])}
    assert rows["Friction level"][1:] == ("-", "", "NOT IDENTIFIABLE")
    assert rows["Power loss, measured"][1:] == ("-", "W", "")
    assert rows["Change"][3] == "sun tooth 7 changed: z = 13.0"
