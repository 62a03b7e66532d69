"""The recordings of the logger: to a bag on disk, or to memory for snapshots."""

from __future__ import annotations

import time
from collections.abc import Callable, Collection
from pathlib import Path

import yaml
from rclpy.logging import get_logger
from rclpy.node import Node

import planetary_twin_py as pt
from planetary_twin_py.recording.ros2.account import TopicAccount
from planetary_twin_py.recording.ros2.bag import BagWriter, free_folder, named_folder
from planetary_twin_py.recording.ros2.provenance import SOFTWARE_RECORD, host_clocks, software
from planetary_twin_py.recording.ros2.ring import Ring

from .parameters import LoggerSettings
from .subscriptions import RecordedTopics, Sink

_SOFTWARE = (
    "planetary_twin_py",
    "planetary_twin",
    "planetary_twin_msgs",
    "mcap",
    "ros-jazzy-rclpy",
    "ros-jazzy-rmw-fastrtps-cpp",
)


class RecorderError(ValueError):
    """A command cannot be executed; the message gives the reason in one line."""


class Recorder:
    """
    Makes the recordings of the logger `node`, one after another.

    `settings` are the parameters of the logger, `own` the newest messages that it has published.
    `failed` is called with the reason if a recording cannot continue, `progressed` after every
    400 messages. Methods raise `RecorderError` if the command cannot be executed.
    """

    def __init__(
        self,
        node: Node,
        settings: LoggerSettings,
        own: Collection[bytes],
        failed: Callable[[str], None],
        progressed: Callable[[], None],
    ) -> None:
        self._node = node
        self._settings = settings
        self._own = own
        self._failed = failed
        self._progressed = progressed
        self._scene = _scene_text(settings.scene)
        self._sink: Sink | None = None
        self._topics: RecordedTopics | None = None
        self._start = time.monotonic()

    @property
    def file(self) -> str:
        """Path of the file being written; empty without one."""
        return str(self._sink.file) if isinstance(self._sink, BagWriter) else ""

    @property
    def size(self) -> int:
        """Bytes of the file, or in memory, so far."""
        return self._sink.size if self._sink else 0

    @property
    def duration(self) -> float:
        """Time since the start of the recording [s]."""
        return time.monotonic() - self._start if self._sink else 0.0

    @property
    def matched(self) -> dict[str, TopicAccount]:
        """Message counts of the topics that have, or have had, a publisher."""
        return self._topics.matched if self._topics else {}

    def begin(self) -> None:
        """Create the recording's file, or the memory for snapshots."""
        duration = self._settings.snapshot_duration
        self._open(Ring(duration) if duration else self._bag())

    def start(self) -> str:
        """Start another recording in a free folder; returns its file."""
        if isinstance(self._sink, Ring):
            raise RecorderError("messages are kept in memory: call ~/snapshot to write them")
        if self._sink is not None:
            raise RecorderError(f"already recording into {self.file}")
        self._open(self._bag(another=True))
        return self.file

    def stop(self) -> str:
        """Finish the recording; returns its file."""
        file = str(self._bag_in_progress().file)
        self.close()
        return file

    def split(self) -> str:
        """Continue in the next file; returns a message that names both files."""
        bag = self._bag_in_progress()
        file = bag.file
        try:
            bag.split()
        except OSError as reason:
            raise RecorderError(self._give_up(reason)) from None
        return f"{file} is finished, continues in {bag.file}"

    def snapshot(self) -> str:
        """Write the messages in memory to a bag; returns its file."""
        ring = self._sink
        if not isinstance(ring, Ring):
            raise RecorderError(
                "snapshot_duration = 0: nothing is kept in memory, all is recorded"
            )
        if not ring.size:
            raise RecorderError("no message has been received yet")
        bag = self._bag(another=True)
        try:
            ring.write_to(bag)
            bag.close()
        except OSError as reason:
            bag.abandon()
            raise RecorderError(_failure(bag.file, reason)) from None
        return str(bag.file)

    def discover(self) -> bool:
        """Subscribe to new topics; returns whether a topic has appeared or disappeared."""
        if self._topics is None:
            return False
        before = list(self.matched)
        try:
            self._topics.discover()
        except OSError as reason:
            self._fail(reason)
        return list(self.matched) != before

    def pause(self) -> None:
        """Unsubscribe; the file stays open, and what it contains is readable."""
        if self._topics is not None:
            try:
                self._topics.drain()
            except OSError as reason:
                self._fail(reason)
                return
            self._topics.close()
        self.flush()

    def flush(self) -> None:
        """Write everything received so far to the disk."""
        try:
            if self._sink is not None:
                self._sink.flush()
        except OSError as reason:
            self._fail(reason)

    def close(self) -> None:
        """Finish the recording, with its message counts; messages in memory are discarded."""
        sink, topics, self._sink, self._topics = self._sink, self._topics, None, None
        if topics is None:
            return
        if not isinstance(sink, BagWriter):
            topics.close()
            return
        try:
            topics.drain()
            topics.close()
            sink.close()
        except OSError as reason:
            topics.close()
            sink.abandon()
            raise RecorderError(_failure(sink.file, reason)) from None
        text = f"{sink.file}: {_summary(topics.accounts)}"
        # After a signal, the node's logger can no longer publish to /rosout.
        running = self._node.context.ok()
        logger = self._node.get_logger() if running else get_logger("recording")
        if any(account.missed for account in topics.accounts.values()):
            logger.warning(text)
        else:
            logger.info(text)

    def _open(self, sink: Sink) -> None:
        self._sink = sink
        try:
            if self._scene:
                sink.attach("scene.yaml", self._scene, "application/yaml")
            self._topics = RecordedTopics(
                self._node, self._settings.chosen, self._own, sink, self._fail, self._progressed
            )
            self._start = time.monotonic()
            if self.file:
                self._node.get_logger().info(f"recording into {self.file}")
        except BaseException:  # Ctrl-C, for example: nothing has been recorded
            self._sink = None
            if isinstance(sink, BagWriter):
                sink.discard()
            raise

    def _bag_in_progress(self) -> BagWriter:
        if not isinstance(self._sink, BagWriter):
            raise RecorderError("nothing is being recorded")
        return self._sink

    def _bag(self, another: bool = False) -> BagWriter:
        """Open a bag in the folder that `name` gives, or in a free one if `another` is True."""
        directory, name = self._settings.folder, self._settings.name
        while True:
            folder = named_folder(directory, name) if name else None
            if folder is None or another:
                stem = name or self._node.get_namespace().strip("/").replace("/", "_")
                folder = free_folder(directory, stem or "twin")
            try:
                bag = BagWriter(folder, self._settings.storage(), self._clocks)
            except OSError as reason:
                taken = isinstance(reason, FileExistsError) and folder.exists()
                if not taken:
                    raise RecorderError(f"directory = {directory}: {reason.strerror}") from None
                if name and not another:
                    raise RecorderError(
                        f"name = {name}: {folder} exists; choose a free name"
                    ) from None
                # Another logger has just created that folder: try the next.
            else:
                bag.describe(SOFTWARE_RECORD, software(_SOFTWARE))
                return bag

    def _clocks(self) -> dict[str, str]:
        return host_clocks() | {"ros": str(self._node.get_clock().now().nanoseconds)}

    def _fail(self, reason: OSError) -> None:
        self._failed(self._give_up(reason))

    def _give_up(self, reason: OSError) -> str:
        """Abandon a bag that can no longer be written; returns the reason."""
        sink, topics, self._sink, self._topics = self._sink, self._topics, None, None
        if topics is not None:
            topics.close()
        if not isinstance(sink, BagWriter):
            return str(reason)
        sink.abandon()
        return _failure(sink.file, reason)


def _scene_text(scene: str) -> bytes:
    if not scene:
        return b""
    content = pt.load_scene(scene).model_dump(mode="json")
    return yaml.safe_dump(content, sort_keys=False).encode()


def _failure(file: Path, reason: OSError) -> str:
    return f"{file}: {reason.strerror}; flushed messages are readable"


def _summary(accounts: dict[str, TopicAccount]) -> str:
    recorded = sum(account.recorded for account in accounts.values())
    losses = ", ".join(f"{name} {a.missed}" for name, a in accounts.items() if a.missed)
    early = ", ".join(f"{n} {a.lost - a.missed}" for n, a in accounts.items() if a.lost > a.missed)
    text = f"recorded {recorded} messages, lost {losses or 'none'}"
    return f"{text}; published before the recording started: {early}" if early else text
