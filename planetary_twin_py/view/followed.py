"""Curves of a measured gearbox and of its twin, with the differences."""

from __future__ import annotations

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from ..recording.runs.followed import Followed, MessageColumns, read_followed
from ..recording.runs.reader import Recording
from ..recording.runs.series import Series
from ..units.catalogue import TRAIN
from . import timeline
from .layer import Layer
from .plots import log_series

Array = NDArray[np.float64]

PLACE = "followed"
EVENTS = f"{PLACE}/events"
_MEASURED, _TWIN, _BOUND = (236, 176, 64), (120, 170, 236), (150, 158, 170)
_LEFT = (205, 104, 86)


PAIRS = {name: TRAIN[name] for name in ("input_torque", "input_speed", "power_loss")}
"""Quantities that are both measured and simulated, by name."""
ALONE = {
    "friction_level": "Friction level: tooth friction over that of the scene, with 95 % interval",
    "innovation": "Balance of the torques: measured minus expected [N m]",
}
"""Titles of plots of quantities that are not simulated."""


def followed_of(recording: Recording) -> Followed | None:
    """Messages of the follower in a recording; None if there are none."""
    return read_followed(recording.path, recording.namespace, recording.topics)


def log_followed(layer: Layer, recording: Recording, followed: Followed) -> None:
    """Log measured and simulated quantities, residuals, friction level and changes.

    Args:
        layer: layer to draw into.
        recording: recording of the twin; its states are interpolated at the stamps of estimates.
        followed: messages of the follower.
    """
    estimate, state = followed.estimate, recording.state
    index = _index(state, estimate.stamp)
    measured = {
        "input_torque": _with_bounds(estimate, "input_torque"),
        "input_speed": estimate["input_speed"][:, None],
        "power_loss": _with_bounds(estimate, "loss_torque")
        * np.abs(estimate["input_speed"])[:, None],
    }
    for name, quantity in PAIRS.items():
        values, twin = measured[name], _twin_values(state, name, estimate.stamp)
        bounds = ["low", "high"][: values.shape[1] - 1]
        columns = quantity.factor * np.column_stack([values[:, 0], twin, values[:, 1:]])
        names, colours = ["measured", "twin", *bounds], [_MEASURED, _TWIN, _BOUND, _BOUND]
        log_series(layer, f"{PLACE}/{name}", index, columns, names, colours)
        residual = quantity.factor * (values[:, :1] - twin[:, None])
        log_series(
            layer, f"{PLACE}/{name}_residual", index, residual, ["measured minus twin"], [_LEFT]
        )
    level = _with_bounds(estimate, "friction_level")
    names = ["friction level", "low", "high"]
    log_series(layer, f"{PLACE}/friction_level", index, level, names, [_MEASURED, _BOUND, _BOUND])
    _log_balance(layer, state, followed.residuals)
    stamps = np.array([stamp for stamp, _ in followed.events], dtype=np.int64)
    text = [layer.label(words) for _, words in followed.events]
    columns_of_text = rr.TextLog.columns(text=text, level=["WARN"] * len(text))
    layer.send_columns(EVENTS, _index(state, stamps), columns_of_text)


def _log_balance(layer: Layer, state: Series, residuals: MessageColumns) -> None:
    sd = 2.0 * residuals["innovation_sd"]
    columns = np.column_stack([residuals["innovation"], -sd, sd])
    names = ["measured minus expected", "-2 sd", "+2 sd"]
    colours = [_LEFT, _BOUND, _BOUND]
    log_series(
        layer, f"{PLACE}/innovation", _index(state, residuals.stamp), columns, names, colours
    )


def _with_bounds(estimate: MessageColumns, name: str) -> Array:
    """A quantity with its 95 % interval, (n, 3)."""
    return np.column_stack([estimate[name], estimate[f"{name}_low"], estimate[f"{name}_high"]])


def _index(state: Series, stamp: NDArray[np.int64]) -> list[rr.TimeColumn]:
    """Both times of the stamps; simulated time runs on as ROS time beyond the twin's messages."""
    first, last = int(state.stamp[0]), int(state.stamp[-1])
    since = 1e-9 * (stamp - first).astype(float)
    state_since = 1e-9 * (state.stamp - first).astype(float)
    beyond = np.minimum(since, 0.0) + np.maximum(since - 1e-9 * (last - first), 0.0)
    return timeline.columns(np.interp(since, state_since, state.time) + beyond, stamp)


def _twin_values(state: Series, field: str, stamp: NDArray[np.int64]) -> Array:
    """A field of the twin at some stamps; NaN outside its messages."""
    first = int(state.stamp[0])
    since, state_since = (1e-9 * (stamps - first).astype(float) for stamps in (stamp, state.stamp))
    return np.interp(since, state_since, state[field], left=np.nan, right=np.nan)
