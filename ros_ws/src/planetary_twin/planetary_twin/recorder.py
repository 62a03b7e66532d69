"""What the logger records now: into a bag, or into memory of which snapshots are taken."""

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

from .logger_parameters import Wishes
from .taps import Taps

_SOFTWARE = (
    "planetary_twin_py",
    "planetary_twin",
    "planetary_twin_msgs",
    "mcap",
    "ros-jazzy-rclpy",
    "ros-jazzy-rmw-fastrtps-cpp",
)


class Refused(Exception):
    """What cannot be done; the message says why in one line."""


class Recorder:
    """
    One recording after another; `failed` hears why one cannot go on.

    `progressed` is called after every 400 messages.

    `own` are the newest messages that the node itself has published.
    Raises `Refused` where something cannot be done.
    """

    def __init__(
        self,
        node: Node,
        wishes: Wishes,
        own: Collection[bytes],
        failed: Callable[[str], None],
        progressed: Callable[[], None],
    ) -> None:
        self._node = node
        self._wishes = wishes
        self._own = own
        self._failed = failed
        self._progressed = progressed
        self._scene = _scene_text(wishes.scene)
        self._sink: BagWriter | Ring | None = None
        self._taps: Taps | None = None
        self._begun = time.monotonic()

    @property
    def file(self) -> str:
        """Path of the file being written; empty where there is none."""
        return str(self._sink.file) if isinstance(self._sink, BagWriter) else ""

    @property
    def size(self) -> int:
        """Bytes of the file, or in memory, so far."""
        return self._sink.size if self._sink else 0

    @property
    def duration(self) -> float:
        """Since the recording began [s]."""
        return time.monotonic() - self._begun if self._sink else 0.0

    @property
    def heard(self) -> dict[str, TopicAccount]:
        """Accounts by topic of what is, or was, heard."""
        return self._taps.heard if self._taps else {}

    def begin(self) -> None:
        """Create the recording's file, or the memory for snapshots."""
        wishes = self._wishes
        self._open(Ring(wishes.snapshot_duration) if wishes.snapshot_duration else self._bag())

    def start(self) -> str:
        """Begin another recording, in a free folder; returns its file."""
        if isinstance(self._sink, Ring):
            raise Refused("messages are kept in memory: call ~/snapshot to write them")
        if self._sink is not None:
            raise Refused(f"already recording into {self.file}")
        self._open(self._bag(anew=True))
        return self.file

    def stop(self) -> str:
        """Finish the recording; returns its file."""
        file = str(self._bag_in_progress().file)
        self.close()
        return file

    def split(self) -> str:
        """Go on in the next file; returns the one that is finished."""
        bag = self._bag_in_progress()
        file = bag.file
        try:
            bag.split()
        except OSError as reason:
            raise Refused(self._give_up(reason)) from None
        return f"{file} is finished, goes on in {bag.file}"

    def snapshot(self) -> str:
        """Write what is in memory; returns the file."""
        ring = self._sink
        if not isinstance(ring, Ring):
            raise Refused("snapshot_duration = 0: nothing is kept in memory, all is recorded")
        if not ring.size:
            raise Refused("nothing has been heard yet")
        bag = self._bag(anew=True)
        try:
            ring.pour(bag)
            bag.close()
        except OSError as reason:
            bag.abandon()
            raise Refused(_told(bag.file, reason)) from None
        return str(bag.file)

    def discover(self) -> bool:
        """Listen to topics that have appeared; whether any has, or has vanished."""
        if self._taps is None:
            return False
        before = list(self.heard)
        try:
            self._taps.discover()
        except OSError as reason:
            self._fail(reason)
        return list(self.heard) != before

    def pause(self) -> None:
        """Listen no more; the file stays open and whole."""
        if self._taps is not None:
            self._taps.close()
        self.flush()

    def flush(self) -> None:
        """Bring everything received so far onto the disk."""
        try:
            if self._sink is not None:
                self._sink.flush()
        except OSError as reason:
            self._fail(reason)

    def close(self) -> None:
        """Finish what is being recorded, with its account; memory is forgotten."""
        sink, taps, self._sink, self._taps = self._sink, self._taps, None, None
        if taps is None:
            return
        taps.close()
        if not isinstance(sink, BagWriter):
            return
        try:
            sink.close()
        except OSError as reason:
            sink.abandon()
            raise Refused(_told(sink.file, reason)) from None
        text = f"{sink.file}: {_summary(taps.accounts)}"
        # A signal may have shut down what the node's own logger publishes to.
        ours = self._node.context.ok()
        logger = self._node.get_logger() if ours else get_logger("recording")
        if any(account.missed for account in taps.accounts.values()):
            logger.warning(text)
        else:
            logger.info(text)

    def _open(self, sink: BagWriter | Ring) -> None:
        if self._scene:
            sink.attach("scene.yaml", self._scene, "application/yaml")
        self._sink = sink
        self._taps = Taps(
            self._node, self._wishes.topics, self._own, sink, self._fail, self._progressed
        )
        self._begun = time.monotonic()
        if self.file:
            self._node.get_logger().info(f"recording into {self.file}")

    def _bag_in_progress(self) -> BagWriter:
        if not isinstance(self._sink, BagWriter):
            raise Refused("nothing is being recorded")
        return self._sink

    def _bag(self, anew: bool = False) -> BagWriter:
        """Open a bag in the folder that is named, or, for one more, in a free one."""
        directory, name = self._wishes.directory, self._wishes.name
        while True:
            folder = named_folder(directory, name) if name else None
            if folder is None or anew:
                stem = name or self._node.get_namespace().strip("/").replace("/", "_")
                folder = free_folder(directory, stem or "twin")
            try:
                bag = BagWriter(folder, self._wishes.storage, self._clocks)
            except OSError as reason:
                taken = isinstance(reason, FileExistsError) and folder.exists()
                if not taken:
                    raise Refused(f"directory = {directory}: {reason.strerror}") from None
                if name and not anew:
                    raise Refused(f"name = {name}: {folder} exists; choose a free name") from None
                # Another logger has just taken that one.
            else:
                bag.describe(SOFTWARE_RECORD, software(_SOFTWARE))
                return bag

    def _clocks(self) -> dict[str, str]:
        return host_clocks() | {"ros": str(self._node.get_clock().now().nanoseconds)}

    def _fail(self, reason: OSError) -> None:
        self._failed(self._give_up(reason))

    def _give_up(self, reason: OSError) -> str:
        """Let go of a bag that cannot be written any more; returns why."""
        sink, taps, self._sink, self._taps = self._sink, self._taps, None, None
        if taps is not None:
            taps.close()
        if not isinstance(sink, BagWriter):
            return str(reason)
        sink.abandon()
        return _told(sink.file, reason)


def _scene_text(scene: str) -> bytes:
    if not scene:
        return b""
    content = pt.load_scene(scene).model_dump(mode="json")
    return yaml.safe_dump(content, sort_keys=False).encode()


def _told(file: Path, reason: OSError) -> str:
    return f"{file}: {reason.strerror}; what was flushed is readable"


def _summary(accounts: dict[str, TopicAccount]) -> str:
    recorded = sum(account.recorded for account in accounts.values())
    losses = ", ".join(f"{name} {a.missed}" for name, a in accounts.items() if a.missed)
    early = ", ".join(f"{n} {a.lost - a.missed}" for n, a in accounts.items() if a.lost > a.missed)
    text = f"recorded {recorded} messages, lost {losses or 'none'}"
    return f"{text}; published before it began: {early}" if early else text
