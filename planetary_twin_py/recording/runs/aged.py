"""Reads the damage of the parts of a twin from a recording."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ros2.topics import DAMAGE
from .schedule import messages_of, stamp_of


class Aged(NamedTuple):
    """Damage over time."""

    parts: tuple[str, ...]
    """Names of the parts."""
    time: NDArray[np.float64]
    """Simulated time [s], (n,)."""
    stamp: NDArray[np.int64]
    """ROS time [ns], (n,)."""
    damage: NDArray[np.float64]
    """Miner sums, (n, parts)."""


def read_aged(path: Path, namespace: str, topics: frozenset[str]) -> Aged | None:
    """Read the damage of a twin.

    Args:
        path: path of an .mcap file, or of a folder of them.
        namespace: namespace of the gearbox.
        topics: names of the topics in the files.

    Returns:
        The damage; None if there is none.

    Raises:
        RecordingError: a message does not match its definition.
    """
    if f"{namespace}/{DAMAGE}" not in topics:
        return None
    found = [message for _, message in messages_of(path, namespace, (DAMAGE,), [])]
    if not found:
        return None
    return Aged(
        tuple(found[0].parts),
        np.array([message.simulated_time for message in found]),
        np.array([stamp_of(message) for message in found], dtype=np.int64),
        np.array([message.damage for message in found]),
    )
