"""Writes a recording: a bag folder with one or several MCAP files, in the layout of rosbag2."""

from __future__ import annotations

import os
import reprlib
import shutil
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
_LONGEST_NAME = 200  # bytes; file systems allow 255, including the suffix of a file
Clocks = Callable[[], Mapping[str, str]]


class BagWriter:
    """Writes one recording, from an empty folder to its last finished file.

    Each file is self-contained: it repeats attachments, metadata, and the latched messages that
    are valid at its start. Data written before the last `flush` survive a kill and a power failure.

    Args:
        folder: folder to create.
        storage: compression, chunk size and limits of a file.
        clocks: returns clock readings, which are written at both ends of each file and once a
            minute.
        attached: time of the attachments [ns]; None: now.

    Raises:
        FileExistsError: `folder` exists.
        OSError: it cannot be written.
    """

    def __init__(
        self,
        folder: Path,
        storage: Storage | None = None,
        clocks: Clocks | None = None,
        attached: int | None = None,
    ) -> None:
        folder.mkdir(parents=True)
        self.folder = folder
        self._storage = storage or Storage()
        self._clocks = clocks
        self._attached_at = attached
        self._topics: list[Topic] = []  # of channels 1, 2, 3, ...
        self._accounts: dict[str, TopicAccount] = {}
        self._counted: Counter[tuple[str, str]] = Counter()  # account totals in finished files
        self._attached: dict[str, tuple[bytes, str]] = {}
        self._described: dict[str, Mapping[str, str]] = {}
        self._latched = Latched()
        self._finished: list[McapFile] = []
        try:
            self._file = self._next_file()
        except BaseException:  # Ctrl-C, for example: there is no recording then
            shutil.rmtree(folder, ignore_errors=True)
            raise

    @property
    def file(self) -> Path:
        """The current file, or the last one."""
        return self._file.path

    @property
    def closed(self) -> bool:
        """Whether the recording is finished or abandoned."""
        return self._file.closed

    @property
    def size(self) -> int:
        """Size of the file [bytes], without the current chunk."""
        return self._file.size

    def attach(self, name: str, data: bytes, media_type: str) -> None:
        """Add an attachment, e.g. the scene; repeated calls with the same data have no effect."""
        if self._attached.get(name) != (data, media_type):
            self._attached[name] = data, media_type
            self._file.attach(name, data, media_type, self._attached_at)

    def describe(self, name: str, values: Mapping[str, str]) -> None:
        """Add a metadata record to this file and all following files."""
        self._described[name] = values
        self._file.note(name, values)

    def note(self, name: str, values: Mapping[str, str]) -> None:
        """Add a metadata record to this file."""
        self._file.note(name, values)

    def add_topic(self, topic: Topic, account: TopicAccount | None = None) -> int:
        """Open a channel.

        Args:
            topic: topic of the channel.
            account: account of lost messages; its counts are written at the end of each file.

        Returns:
            Number of the channel, for `write`.
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
        """Append a serialised message, received at `log_time` and sent at `publish_time` [ns]."""
        if self._file.full(log_time):
            self.split()
        self._file.write(channel, data, log_time, publish_time, sequence)
        if channel in self._latched:
            self._latched.keep(Serialised(channel, data, log_time, publish_time, sequence))

    def flush(self) -> None:
        """Write all buffered data to the disk (fsync)."""
        if time.monotonic() - self._clocks_noted >= _CLOCKS_PERIOD:
            self._note_clocks()
        self._file.flush()

    def split(self) -> None:
        """Finish the file and continue in the next one."""
        self._finish_file()
        end = self._file.extent.end
        self._file = self._next_file()
        for message in self._latched:
            # Stamped with the end of the previous file, so that time spans do not overlap.
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
        """Close a file that is no longer writable, e.g. on a full disk."""
        self._file.abandon()

    def discard(self) -> None:
        """Delete the recording."""
        self.abandon()
        shutil.rmtree(self.folder, ignore_errors=True)

    def _next_file(self) -> McapFile:
        name = f"{self.folder.name}_{len(self._finished)}.mcap"
        self._file = file = McapFile(self.folder / name, self._storage)
        for attached, content in self._attached.items():
            file.attach(attached, *content, self._attached_at)
        for described, values in self._described.items():
            file.note(described, values)
        self._note_clocks()
        for topic in self._topics:
            file.add_topic(topic)
        file.flush()
        _sync_folder(self.folder)
        return file

    def _finish_file(self) -> None:
        """Write metadata and close the file."""
        file = self._file
        for name, account in self._accounts.items():
            file.note(ACCOUNT_RECORD, {"topic": name, **self._new_counts(name, account)})
        self._note_clocks()
        topics = [
            (topic, file.counts[number]) for number, topic in enumerate(self._topics, start=1)
        ]
        file.note("rosbag2", metadata_record(bag_metadata([_entry(file)], topics)))
        file.finish()
        self._finished.append(file)

    def _new_counts(self, name: str, account: TopicAccount) -> dict[str, str]:
        """Counts of an account since the previous file."""
        counts = {}
        for figure in ("recorded", "lost", "missed", "before", "reported"):
            total = getattr(account, figure)
            counts[figure] = str(total - self._counted[name, figure])
            self._counted[name, figure] = total
        return counts

    def _note_clocks(self) -> None:
        self._clocks_noted = time.monotonic()
        if self._clocks is not None:
            self._file.note(CLOCKS_RECORD, self._clocks())


def write_as(out: Path, write: Callable[[Path], Path]) -> Path:
    """Write a bag folder, or a single file.

    Args:
        out: folder, or a file that ends in .mcap.
        write: writes a bag into the given folder and returns its file.

    Raises:
        FileExistsError: `out` exists.
    """
    if out.suffix != ".mcap":
        return write(out)
    if out.exists():
        raise FileExistsError(17, "already exists", str(out))
    with tempfile.TemporaryDirectory(dir=out.parent, prefix=".") as folder:
        return write(Path(folder) / out.stem).rename(out)


def named_folder(directory: Path, name: str) -> Path:
    """The folder `name` in `directory`.

    Raises:
        ValueError: `name` is a path, or not a valid file name.
    """
    plain = name.isprintable() and name not in ("", ".", "..") and Path(name).name == name
    if not plain or len(name.encode()) > _LONGEST_NAME:
        raise ValueError(
            f"{reprlib.repr(name)}: must be a plain name of at most {_LONGEST_NAME} bytes; "
            f"the folder is {directory}/"
        )
    return directory / name


def free_folder(directory: Path, stem: str) -> Path:
    """A folder in `directory` that does not exist yet: `stem` with date and time."""
    base = directory / f"{stem}_{time.strftime('%Y%m%d_%H%M%S')}"
    folder, attempt = base, 1
    while folder.exists():
        attempt += 1
        folder = base.with_name(f"{base.name}_{attempt}")
    return folder


def _entry(file: McapFile) -> FileEntry:
    return FileEntry(file.path.name, file.extent, file.counts.total())


def _sync_folder(folder: Path) -> None:
    """Write the directory entry of a new file to the disk."""
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
