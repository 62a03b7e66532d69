"""What a user chooses of a recording: the logger's parameters."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from rclpy.node import Node

from planetary_twin_py.recording.storage import CHUNK_SIZES, COMPRESSIONS, Storage

from .parameters import declare_bounded, declare_fixed

_LONGEST = 1e6  # [s]
_LARGEST = 1e6  # [MB]


@dataclass(frozen=True)
class Wishes:
    """Where to record, what, and how."""

    directory: Path
    name: str
    topics: list[str]
    scene: str
    flush_period: float  # [s]
    snapshot_duration: float  # [s]
    storage: Storage


def declare_wishes(node: Node) -> Wishes:
    """
    Declare the parameters and return their values.

    Raises `ValueError` for one that cannot be.
    """
    return Wishes(
        Path(declare_fixed(node, "directory", "recordings", "where recordings land")).expanduser(),
        declare_fixed(node, "name", "", "folder of the recording; empty: a free one is found"),
        _given(node, "topics", "topics to record; empty: those of the namespace"),
        declare_fixed(
            node, "scene", "", "scene to keep in the recording, so that viewers know the gears"
        ),
        declare_bounded(
            node, "flush_period", 0.5, (0.01, 60.0), "longest stretch that a kill can cost [s]"
        ),
        declare_bounded(
            node,
            "snapshot_duration",
            0.0,
            (0.0, 3600.0),
            "keep so much in memory, written when ~/snapshot is called [s]; 0: record to disk",
        ),
        _declare_storage(node),
    )


def _given(node: Node, name: str, description: str) -> list[str]:
    # rclpy knows the type of a list from an element.
    return [value for value in declare_fixed(node, name, [""], description) if value]


def _declare_storage(node: Node) -> Storage:
    kinds = ", ".join(COMPRESSIONS)
    return Storage(
        declare_fixed(node, "compression", "zstd", f"of chunks: {kinds}"),
        declare_bounded(
            node, "chunk_size", 1.0, CHUNK_SIZES, "of a chunk before compression [MB]"
        ),
        declare_bounded(
            node,
            "split_duration",
            0.0,
            (0.0, _LONGEST),
            "of a file, then the next [s]; 0: no limit",
        ),
        declare_bounded(
            node, "split_size", 0.0, (0.0, _LARGEST), "of a file, then the next [MB]; 0: no limit"
        ),
    )
