"""What a user chooses of a recording: the logger's parameters."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from rclpy.node import Node

from planetary_twin_py.recording.container.storage import CHUNK_SIZES, COMPRESSIONS, Storage

from .parameter_node import ParameterNode
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


def declare_wishes(node: ParameterNode) -> None:
    """
    Declare the parameters, which may change until the node is configured.

    Raises `ValueError` for one that is given at the start and out of its range.
    """
    declare_fixed(node, "directory", "recordings", "where recordings land")
    declare_fixed(node, "name", "", "folder of the recording; empty: a free one is found")
    # rclpy knows the type of a list from an element.
    declare_fixed(node, "topics", [""], "topics to record; empty: those of the namespace")
    declare_fixed(
        node, "scene", "", "scene to keep in the recording, so that viewers know the gears"
    )
    declare_bounded(
        node, "flush_period", 0.5, (0.01, 60.0), "longest stretch that a kill can cost [s]"
    )
    declare_bounded(
        node,
        "snapshot_duration",
        0.0,
        (0.0, 3600.0),
        "keep so much in memory, written when ~/snapshot is called [s]; 0: record to disk",
    )
    declare_fixed(node, "compression", "zstd", f"of chunks: {', '.join(COMPRESSIONS)}")
    declare_bounded(node, "chunk_size", 1.0, CHUNK_SIZES, "of a chunk before compression [MB]")
    declare_bounded(
        node, "split_duration", 0.0, (0.0, _LONGEST), "of a file, then the next [s]; 0: no limit"
    )
    declare_bounded(
        node, "split_size", 0.0, (0.0, _LARGEST), "of a file, then the next [MB]; 0: no limit"
    )


def wishes_of(node: Node) -> Wishes:
    """
    Return the values in force.

    Raises `ValueError` for one that cannot be.
    """
    value = {
        name: parameter.value for name, parameter in node.get_parameters_by_prefix("").items()
    }
    return Wishes(
        Path(value["directory"]).expanduser(),
        value["name"],
        [topic for topic in value["topics"] if topic],
        value["scene"],
        value["flush_period"],
        value["snapshot_duration"],
        Storage(
            value["compression"],
            value["chunk_size"],
            value["split_duration"],
            value["split_size"],
        ),
    )
