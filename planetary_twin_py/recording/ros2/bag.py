"""Writes a recording: a bag folder with one or several MCAP files, as rosbag2 lays it out."""

from __future__ import annotations

import os
import reprlib
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Mapping
from pathlib import Path

from ..container.storage import Storage
from .account import TopicAccount
from .latched import Latched, Serialised
from .mcap_file import McapFile
from .metadata import FileEntry, Topic, bag_metadata, metadata_record, metadata_yaml

ACCOUNT_RECORD = "planetary_twin_account"
CLOCKS_RECORD = "planetary_twin_clocks"
_CLOCKS_PERIOD = 60.0  # [s]
_LONGEST_NAME = 200  # bytes; file systems take 255, of which the file's own ending needs some
Clocks = Callable[[], Mapping[str, str]]


class BagWriter:
    """One recording, from an empty folder to its last finished file.

    Each file is enough for itself: it repeats what is attached, what is described, and the messages
    of latched topics that hold when it begins. What `clocks` says is noted at both ends of each
    file and once a minute.

    What `flush` has returned for survives a kill and a power cut; what came later may not.
    Raises `FileExistsError` where `folder` exists, and `OSError` where it cannot be written.
    """

    def __init__(
        self, folder: Path, storage: Storage | None = None, clocks: Clocks | None = None
    ) -> None:
        folder.mkdir(parents=True)
        self.folder = folder
        self._storage = storage or Storage()
        self._clocks = clocks
        self._topics: list[Topic] = []  # of channels 1, 2, 3, ...
        self._accounts: dict[str, TopicAccount] = {}
        self._told: Counter[tuple[str, str]] = Counter()  # of the accounts, in finished files
        self._attached: dict[str, tuple[bytes, str]] = {}
        self._described: dict[str, Mapping[str, str]] = {}
        self._latched = Latched()
        self._finished: list[McapFile] = []
        self._file = self._next_file()

    @property
    def file(self) -> Path:
        """The file being written, or the last one."""
        return self._file.path

    @property
    def closed(self) -> bool:
        """Whether the recording is finished, or given up."""
        return self._file.closed

    @property
    def size(self) -> int:
        """Bytes of the file so far; the chunk in progress comes on top."""
        return self._file.size

    def attach(self, name: str, data: bytes, media_type: str) -> None:
        """Add a file beside the messages, e.g. the scene; the same one only once."""
        if self._attached.get(name) != (data, media_type):
            self._attached[name] = data, media_type
            self._file.attach(name, data, media_type)

    def describe(self, name: str, values: Mapping[str, str]) -> None:
        """Add a metadata record that holds for the whole recording."""
        self._described[name] = values
        self._file.note(name, values)

    def note(self, name: str, values: Mapping[str, str]) -> None:
        """Add a metadata record."""
        self._file.note(name, values)

    def add_topic(self, topic: Topic, account: TopicAccount | None = None) -> int:
        """Open a channel; the number returned is the one `write` takes.

        What `account` has counted meanwhile stands at the end of each file.
        """
        channel = self._file.add_topic(topic)
        self._topics.append(topic)
        self._latched.add_topic(channel, topic)
        if account is not None:
            self._accounts[topic.name] = account
        return channel

    def write(
        self, channel: int, data: bytes, log_time: int, publish_time: int, sequence: int
    ) -> None:
        """Append one serialised message, received at `log_time` and sent at `publish_time` [ns]."""
        if self._file.full(log_time):
            self.split()
        self._file.write(channel, data, log_time, publish_time, sequence)
        if channel in self._latched:
            self._latched.keep(Serialised(channel, data, log_time, publish_time, sequence))

    def flush(self) -> None:
        """Bring everything written so far onto the disk."""
        if time.monotonic() - self._clocks_noted >= _CLOCKS_PERIOD:
            self._note_clocks()
        self._file.flush()

    def split(self) -> None:
        """Finish the file and go on in the next."""
        self._finish_file()
        end = self._file.extent.end
        self._file = self._next_file()
        for message in self._latched:
            # At the end of the file before, so that the files' spans do not overlap.
            self._file.write(*message._replace(log_time=max(message.log_time, end)))

    def close(self) -> None:
        """Finish the file, and write `metadata.yaml` beside it."""
        self._finish_file()
        counts = sum((file.counts for file in self._finished), Counter[int]())
        topics = [(topic, counts[number]) for number, topic in enumerate(self._topics, start=1)]
        metadata = bag_metadata([_entry(file) for file in self._finished], topics)
        with (self.folder / "metadata.yaml").open("w", encoding="utf-8") as stream:
            stream.write(metadata_yaml(metadata))
            stream.flush()
            os.fsync(stream.fileno())

    def abandon(self) -> None:
        """Let go of a file that cannot be written any more, e.g. on a full disk."""
        self._file.abandon()

    def _next_file(self) -> McapFile:
        name = f"{self.folder.name}_{len(self._finished)}.mcap"
        self._file = file = McapFile(self.folder / name, self._storage)
        for attached, content in self._attached.items():
            file.attach(attached, *content)
        for described, values in self._described.items():
            file.note(described, values)
        self._note_clocks()
        for topic in self._topics:
            file.add_topic(topic)
        file.flush()
        _sync_folder(self.folder)
        return file

    def _finish_file(self) -> None:
        """Write what a reader of this file alone wants to know, and close it."""
        file = self._file
        for name, account in self._accounts.items():
            file.note(ACCOUNT_RECORD, {"topic": name, **self._untold(name, account)})
        self._note_clocks()
        topics = [
            (topic, file.counts[number]) for number, topic in enumerate(self._topics, start=1)
        ]
        file.note("rosbag2", metadata_record(bag_metadata([_entry(file)], topics)))
        file.finish()
        self._finished.append(file)

    def _untold(self, name: str, account: TopicAccount) -> dict[str, str]:
        """What an account has counted since the file before."""
        untold = {}
        for figure in ("recorded", "lost", "missed", "before", "reported"):
            total = getattr(account, figure)
            untold[figure] = str(total - self._told[name, figure])
            self._told[name, figure] = total
        return untold

    def _note_clocks(self) -> None:
        self._clocks_noted = time.monotonic()
        if self._clocks is not None:
            self._file.note(CLOCKS_RECORD, self._clocks())


def write_as(out: Path, write: Callable[[Path], Path]) -> Path:
    """Have `write` make a bag folder `out`, or one file where that ends in .mcap; returns the file.

    Raises:
        FileExistsError: `out` exists.
    """
    if out.suffix != ".mcap":
        return write(out)
    if out.exists():
        raise FileExistsError(17, "exists", str(out))
    with tempfile.TemporaryDirectory(dir=out.parent, prefix=".") as folder:
        return write(Path(folder) / out.stem).rename(out)


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


def _entry(file: McapFile) -> FileEntry:
    return FileEntry(file.path.name, file.extent, file.counts.total())


def _sync_folder(folder: Path) -> None:
    """Let the name of a new file survive a power cut, too."""
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
