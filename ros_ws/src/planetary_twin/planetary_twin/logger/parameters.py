"""The parameters of the logger."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from planetary_twin_py.recording.container.storage import CHUNK_SIZES, COMPRESSIONS, Storage

from ..base.parameters import setting

_LONGEST = 1e6  # [s]
_LARGEST = 1e6  # [MB]


@dataclass(frozen=True)
class LoggerSettings:
    """What to record, where, and how; may change until the node is configured."""

    directory: str = setting("recordings", "folder in which recordings are created")
    name: str = setting("", "folder of the recording; empty: a free name is chosen")
    topics: Sequence[str] = setting(
        [""],
        "topics to record; empty: those of the namespace, /diagnostics, /tf, and measured ones, "
        "also if they are remapped",
    )
    scene: str = setting("", "scene to store in the recording, from which viewers draw the gears")
    flush_period: float = setting(
        0.5,
        "time between writes to the disk; a killed logger loses at most these messages [s]",
        (0.01, 60.0),
    )
    snapshot_duration: float = setting(
        0.0,
        "duration kept in memory, written when ~/snapshot is called [s]; 0: record to disk",
        (0.0, 3600.0),
    )
    compression: str = setting("zstd", f"of chunks: {', '.join(COMPRESSIONS)}")
    chunk_size: float = setting(1.0, "chunk size before compression [MB]", CHUNK_SIZES)
    split_duration: float = setting(
        0.0, "longest duration of a file [s]; 0: no limit", (0.0, _LONGEST)
    )
    split_size: float = setting(0.0, "largest size of a file [MB]; 0: no limit", (0.0, _LARGEST))

    @property
    def folder(self) -> Path:
        """Folder in which recordings are created."""
        return Path(self.directory).expanduser()

    @property
    def chosen(self) -> list[str]:
        """Topics to record; empty: the usual ones."""
        return [topic for topic in self.topics if topic]

    def storage(self) -> Storage:
        """Return how files are written; raises `ValueError` for an unknown compression."""
        return Storage(
            self.compression,
            self.chunk_size,
            self.split_duration,
            self.split_size,
            self.flush_period,
        )
