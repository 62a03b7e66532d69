"""The parameters of the logger."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from rclpy.node import Node

from planetary_twin_py.recording.container.storage import CHUNK_SIZES, COMPRESSIONS, Storage

from ..base.parameter_node import ParameterNode
from ..base.parameters import declare

_LONGEST = 1e6  # [s]
_LARGEST = 1e6  # [MB]


@dataclass(frozen=True)
class LoggerOptions:
    """What to record, where, and how."""

    directory: Path
    name: str
    topics: list[str]
    scene: str
    flush_period: float  # [s]
    snapshot_duration: float  # [s]
    storage: Storage


def declare_options(node: ParameterNode) -> None:
    """
    Declare the parameters on `node`; they may change until the node is configured.

    Raises `ValueError` if a value given at the start is out of its range.
    """
    declare(node, "directory", "recordings", "folder in which recordings are created")
    declare(node, "name", "", "folder of the recording; empty: a free name is chosen")
    # rclpy derives the type of a list from its first element.
    declare(
        node,
        "topics",
        [""],
        "topics to record; empty: those of the namespace, /diagnostics, /tf, and measured ones, "
        "also if they are remapped",
    )
    declare(
        node, "scene", "", "scene to store in the recording, from which viewers draw the gears"
    )
    declare(
        node,
        "flush_period",
        0.5,
        "time between writes to the disk; a killed logger loses at most these messages [s]",
        (0.01, 60.0),
    )
    declare(
        node,
        "snapshot_duration",
        0.0,
        "duration kept in memory, written when ~/snapshot is called [s]; 0: record to disk",
        (0.0, 3600.0),
    )
    declare(node, "compression", "zstd", f"of chunks: {', '.join(COMPRESSIONS)}")
    declare(node, "chunk_size", 1.0, "chunk size before compression [MB]", CHUNK_SIZES)
    declare(
        node, "split_duration", 0.0, "longest duration of a file [s]; 0: no limit", (0.0, _LONGEST)
    )
    declare(node, "split_size", 0.0, "largest size of a file [MB]; 0: no limit", (0.0, _LARGEST))


def options_of(node: Node) -> LoggerOptions:
    """
    Return the values of the parameters of `node`.

    Raises `ValueError` for an invalid value.
    """
    value = {
        name: parameter.value for name, parameter in node.get_parameters_by_prefix("").items()
    }
    return LoggerOptions(
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
            value["flush_period"],
        ),
    )
