"""Angles of the members on a time grid fine enough for the eye to follow the teeth.

A recording has angles modulo one turn, a hundred times a second; between two of them a fast gear
passes several teeth. The recorded mean speed determines the number of whole turns; the angle is
interpolated linearly between the recorded times.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..recording.runs.reader import Recording
from ..recording.runs.series import Series
from ..recording.runs.unwrapping import unwrap

Column = NDArray[np.float64]
STEPS_PER_PITCH = 6  # avoids that the wheel appears to turn backwards
MOST_ROWS = 40_000  # of motion: about 2 MB per member


@dataclass(frozen=True)
class Motion:
    """`time` [s], `stamp` [ns] (n,); `angle[member]` [rad] (n,), continuous, not modulo a turn."""

    time: NDArray[np.float64]
    stamp: NDArray[np.int64]
    angle: dict[str, NDArray[np.float64]]


def motion(recording: Recording) -> Motion:
    """Motion of sun, planet_1..N, ring and carrier, from GearboxState."""
    state = recording.state
    rows = _rows_per_interval(state)
    time, stamp = _refine(state.time, rows), np.rint(_refine(state.stamp - state.stamp[0], rows))
    angle = {}
    for member, (position, speed) in _members(state, recording.planets).items():
        angle[member] = _refine(unwrap(state.time, position, speed), rows)
    return Motion(time, stamp.astype(np.int64) + state.stamp[0], angle)


def _members(state: Series, planets: int) -> dict[str, tuple[Column, Column]]:
    members = {"sun": (state["sun_angle"], state["sun_speed"])}
    for i in range(planets):
        members[f"planet_{i + 1}"] = state["planet_angle"][:, i], state["planet_speed"][:, i]
    for name in ("ring", "carrier"):
        members[name] = state[f"{name}_angle"], state[f"{name}_speed"]
    return members


def _rows_per_interval(state: Series) -> NDArray[np.int64]:
    """Number of rows for each interval between two recorded states."""
    pitches = np.abs(state["mesh_frequency"][1:]) * np.abs(np.diff(state.time))
    wanted = np.nan_to_num(STEPS_PER_PITCH * pitches)
    room = MOST_ROWS / max(float(wanted.sum()), MOST_ROWS)
    return np.maximum(np.ceil(wanted * room), 1).astype(np.int64)


def _refine(values: Column, rows: NDArray[np.int64]) -> NDArray[np.float64]:
    """`values` with interval k cut into `rows[k]` equal steps."""
    if len(values) < 2:
        return np.asarray(values, dtype=np.float64)
    within = np.arange(rows.sum()) - np.repeat(np.cumsum(rows) - rows, rows)
    share = within / np.repeat(rows, rows)
    refined = np.repeat(values[:-1], rows) + share * np.repeat(np.diff(values), rows)
    return np.append(refined, values[-1])
