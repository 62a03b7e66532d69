"""Reads the messages of a follower of a measured gearbox from a recording."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .schedule import messages_of, stamp_of

Array = NDArray[np.float64]

ESTIMATE, RESIDUALS, EVENT = "follower/estimate", "follower/residuals", "follower/event"
ESTIMATED = (
    "input_speed", "input_torque", "input_torque_low", "input_torque_high", "loss_torque",
    "loss_torque_low", "loss_torque_high", "friction_level", "friction_level_low",
    "friction_level_high",
)  # fmt: skip
BALANCE = "innovation", "innovation_sd"


@dataclass(frozen=True)
class MessageColumns:
    """Messages of one topic as columns."""

    stamp: NDArray[np.int64]
    """ROS time of the last readings used [ns since the epoch], (n,)."""
    columns: dict[str, Array]
    """Fields in SI, (n,) each; NaN where there is no estimate."""

    def __getitem__(self, name: str) -> Array:
        """Return a field by name."""
        return self.columns[name]

    def __len__(self) -> int:
        """Number of messages."""
        return len(self.stamp)


@dataclass(frozen=True)
class Followed:
    """Messages of a follower."""

    estimate: MessageColumns
    """Estimates, with the fields in `ESTIMATED`."""
    residuals: MessageColumns
    """Residuals, with the fields in `BALANCE`."""
    events: tuple[tuple[int, str], ...]
    """ROS time of detection [ns] and description of each change."""


def read_followed(path: Path, namespace: str, topics: frozenset[str]) -> Followed | None:
    """Read the messages of a follower.

    Returns:
        The messages; None if there are none.

    Raises:
        RecordingError: a message does not match its definition.
    """
    if f"{namespace}/{ESTIMATE}" not in topics:
        return None
    found: dict[str, list[Any]] = {name: [] for name in (ESTIMATE, RESIDUALS, EVENT)}
    # The remarks are those of the reader of the twin.
    for name, message in messages_of(path, namespace, tuple(found), []):
        found[name].append(message)
    if not found[ESTIMATE]:
        return None
    # An event is published again if its size changes: the last message counts.
    events = {event.number: event for event in found[EVENT]}
    return Followed(
        _columns(found[ESTIMATE], ESTIMATED),
        _columns(found[RESIDUALS], BALANCE),
        tuple((stamp_of(event), f"{event.what}: {event.evidence}") for event in events.values()),
    )


def _columns(messages: Sequence[Any], names: Sequence[str]) -> MessageColumns:
    """Convert messages to columns in the order of their stamps."""
    stamps = np.array([stamp_of(message) for message in messages], dtype=np.int64)
    order = np.argsort(stamps, kind="stable")
    columns = {
        name: np.array([getattr(message, name) for message in messages], float) for name in names
    }
    return MessageColumns(stamps[order], {name: values[order] for name, values in columns.items()})
