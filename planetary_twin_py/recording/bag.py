"""Writes a recording: a bag folder holding one MCAP file that rosbag2 reads as its own."""

from __future__ import annotations

import os
import reprlib
import time
from collections.abc import Mapping
from pathlib import Path

from mcap.writer import CompressionType, Writer

from .account import TopicAccount
from .rosbag2 import Extent, Topic, bag_metadata

ACCOUNT_RECORD = "planetary_twin_account"
_LIBRARY = "planetary_twin"
_LONGEST_NAME = 200  # bytes; file systems take 255, of which the file's own ending needs some


class BagWriter:
    """One recording, from an empty folder to a finished file.

    What `flush` has returned for survives a kill and a power cut; what came later may not.
    Raises `FileExistsError` where `folder` exists, and `OSError` where it cannot be written.
    """

    def __init__(self, folder: Path) -> None:
        folder.mkdir(parents=True)
        self.folder = folder
        self.file = folder / f"{folder.name}_0.mcap"
        self._stream = self.file.open("xb")
        self._writer = Writer(self._stream, compression=CompressionType.ZSTD, enable_data_crcs=True)
        self._writer.start(profile="ros2", library=_LIBRARY)
        self._channels: dict[int, Topic] = {}
        self._counts: dict[int, int] = {}
        self._extent = Extent()
        self.flush()

    @property
    def closed(self) -> bool:
        """Whether the file is finished, or given up."""
        return self._stream.closed

    @property
    def size(self) -> int:
        """Bytes of the file so far; the chunk in progress comes on top."""
        return self._stream.tell()

    def attach(self, name: str, data: bytes, media_type: str) -> None:
        """Add a file beside the messages, e.g. the scene."""
        now = time.time_ns()
        self._writer.add_attachment(now, now, name, media_type, data)

    def add_topic(self, topic: Topic) -> int:
        """Open a channel; the number returned is the one `write` takes."""
        schema = self._writer.register_schema(topic.type, "ros2msg", topic.definition.encode())
        channel = self._writer.register_channel(
            topic.name,
            "cdr",
            schema,
            {"offered_qos_profiles": topic.qos_yaml, "topic_type_hash": topic.type_hash},
        )
        self._channels[channel] = topic
        self._counts[channel] = 0
        return channel

    def write(
        self, channel: int, data: bytes, log_time: int, publish_time: int, sequence: int
    ) -> None:
        """Append one serialised message, received at `log_time` and sent at `publish_time` [ns]."""
        # MCAP keeps 32 bits of the sequence number.
        self._writer.add_message(channel, log_time, data, publish_time, sequence & 0xFFFFFFFF)
        self._counts[channel] += 1
        self._extent.include(log_time)

    def flush(self) -> None:
        """Bring everything written so far onto the disk."""
        self._writer.flush()  # type: ignore[no-untyped-call]
        os.fsync(self._stream.fileno())

    def close(self, accounts: Mapping[str, TopicAccount] | None = None) -> None:
        """Finish the file: indexes, the loss account by topic, and `metadata.yaml` beside it."""
        topics = [(topic, self._counts[channel]) for channel, topic in self._channels.items()]
        metadata = bag_metadata(self.file.name, topics, self._extent)
        for name, account in (accounts or {}).items():
            self._writer.add_metadata(ACCOUNT_RECORD, {"topic": name, **_figures(account)})
        self._writer.add_metadata("rosbag2", {"serialized_metadata": metadata})
        self._writer.finish()  # type: ignore[no-untyped-call]
        self._stream.flush()
        os.fsync(self._stream.fileno())
        self._stream.close()
        (self.folder / "metadata.yaml").write_text(metadata, encoding="utf-8")

    def abandon(self) -> None:
        """Let go of a file that cannot be written any more, e.g. on a full disk."""
        # Closing the buffered stream would try to write once more; the descriptor must not leak.
        self._stream.raw.close()


def named_folder(directory: Path, name: str) -> Path:
    """The folder `name` in `directory`.

    Raises `ValueError` where it would be elsewhere, or is no name that a file system takes.
    """
    plain = name.isprintable() and name not in ("", ".", "..") and Path(name).name == name
    if not plain or len(name.encode()) > _LONGEST_NAME:
        raise ValueError(
            f"{reprlib.repr(name)}: must be a plain name of at most {_LONGEST_NAME} bytes; "
            f"it lands in {directory}/"
        )
    return directory / name


def free_folder(directory: Path, stem: str) -> Path:
    """A folder in `directory` that does not exist yet: `stem` and the time of day."""
    base = directory / f"{stem}_{time.strftime('%Y%m%d_%H%M%S')}"
    folder, attempt = base, 1
    while folder.exists():
        attempt += 1
        folder = base.with_name(f"{base.name}_{attempt}")
    return folder


def _figures(account: TopicAccount) -> dict[str, str]:
    names = ("recorded", "lost", "missed", "before", "reported")
    return {name: str(getattr(account, name)) for name in names}
