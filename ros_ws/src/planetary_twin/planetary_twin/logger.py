"""The logger node: records topics as they come, serialised, and accounts for each message."""

from __future__ import annotations

import sys
import time
from pathlib import Path
from typing import Any

import yaml
from planetary_twin_msgs.msg import RecorderStatus
from rclpy.event_handler import QoSMessageLostInfo, SubscriptionEventCallbacks
from rclpy.logging import get_logger
from rclpy.qos import DurabilityPolicy
from rclpy.subscription import Subscription
from rclpy.timer import Timer

import planetary_twin_py as pt
from planetary_twin_py.recording.account import TopicAccount
from planetary_twin_py.recording.bag import BagWriter, free_folder, named_folder

from .managed import ManagedNode, NodeError, RCLError, run_node
from .messages import set_stamp
from .parameters import brief, declare_bounded, declare_fixed
from .stamps import STEADY, Rising
from .topics import describe, matching_qos, message_class, wanted_topics

_DISCOVERY_PERIOD = 0.1  # [s]
_STATUS_PERIOD = 1.0  # [s]


class Tap:
    """One recorded topic: its subscription, its channel in the file, its account."""

    def __init__(self, bag: BagWriter, channel: int, latched: bool) -> None:
        self.account = TopicAccount(latched)
        self.subscription: Subscription | None = None
        self._bag = bag
        self._channel = channel

    @property
    def publishers(self) -> int:
        """Publishers matched now."""
        return self.subscription.get_publisher_count() if self.subscription else 0

    def receive(self, raw: bytes, info: dict[str, Any]) -> None:
        """Write one message."""
        number = info["publication_sequence_number"]
        received = info["received_timestamp"] or time.time_ns()
        self._bag.write(self._channel, raw, received, info["source_timestamp"] or received, number)
        self.account.receive(number, self.publishers)

    def told_of_loss(self, event: QoSMessageLostInfo) -> None:
        """The middleware tells of messages it could not deliver."""
        self.account.reported += event.total_count_change


class Logger(ManagedNode):
    """Records from activation to deactivation; the file is finished when the node closes."""

    def __init__(self) -> None:
        super().__init__("logger")
        self._directory = declare_fixed(self, "directory", "recordings", "where recordings land")
        self._name = declare_fixed(
            self, "name", "", "folder of the recording; empty: a free one is found"
        )
        self._chosen = [
            topic
            for topic in declare_fixed(
                self, "topics", [""], "topics to record; empty: those of the namespace"
            )
            if topic
        ]
        self._scene = declare_fixed(
            self, "scene", "", "scene to keep in the recording, so that viewers know the gears"
        )
        self._flush_period = declare_bounded(
            self, "flush_period", 0.5, (0.01, 60.0), "longest stretch that a kill can cost [s]"
        )
        self._bag: BagWriter | None = None
        self._taps: dict[str, Tap] = {}
        self._refused: set[str] = set()
        self._ticking: list[Timer] = []
        self._begun = 0
        self._status = RecorderStatus()
        self._now = Rising(self.get_clock())
        self._status_publisher = self.create_publisher(RecorderStatus, "~/status", 10)

    def configure(self) -> None:
        """Create the recording's folder and file."""
        scene = pt.load_scene(self._scene).model_dump(mode="json") if self._scene else None
        directory = Path(self._directory).expanduser()
        self._check_topics()
        self._bag = self._new_bag(directory)
        if scene is not None:
            text = yaml.safe_dump(scene, sort_keys=False)
            self._bag.attach("scene.yaml", text.encode(), "application/yaml")
        self._taps, self._refused = {}, set()
        self._begun = time.monotonic_ns()
        self.get_logger().info(f"recording into {self._bag.file}")

    def activate(self) -> None:
        """Subscribe to what there is, and to what appears later."""
        self._ticking = [
            self.create_timer(_DISCOVERY_PERIOD, self._discover, clock=STEADY),
            self.create_timer(self._flush_period, self._flush, clock=STEADY),
            self.create_timer(_STATUS_PERIOD, self._publish_status, clock=STEADY),
        ]

    def deactivate(self) -> None:
        """Stop recording; the file stays open and whole."""
        self._stop_listening()
        self._flush()

    def _stop_listening(self) -> None:
        for timer in self._ticking:
            self.destroy_timer(timer)
        self._ticking = []
        for tap in self._taps.values():
            if tap.subscription is not None:
                self.destroy_subscription(tap.subscription)
                tap.subscription = None

    def close(self) -> None:
        """Finish the file with its account."""
        if self._bag is None:
            return
        self._stop_listening()
        bag, self._bag = self._bag, None
        accounts = {name: tap.account for name, tap in self._taps.items()}
        try:
            bag.close(accounts)
        except OSError as reason:
            bag.abandon()
            raise NodeError(
                f"{bag.file}: {reason.strerror}; what was flushed is readable"
            ) from None
        # Under a name of its own: a signal has shut down what the node's name would publish to.
        get_logger("recording").info(f"{bag.file}: {_summary(accounts)}")

    def _new_bag(self, directory: Path) -> BagWriter:
        while True:
            folder = self._folder(directory)
            try:
                return BagWriter(folder)
            except OSError as reason:
                taken = isinstance(reason, FileExistsError) and folder.exists()
                if not taken:
                    raise NodeError(f"directory = {directory}: {reason.strerror}") from None
                if self._name:
                    refusal = f"name = {self._name}: {folder} exists; choose a free name"
                    raise NodeError(refusal) from None
                # Another logger has just taken that one.

    def _folder(self, directory: Path) -> Path:
        """Where the recording goes: never elsewhere than in `directory`."""
        if not self._name:
            stem = self.get_namespace().strip("/").replace("/", "_")
            return free_folder(directory, stem or "twin")
        try:
            return named_folder(directory, self._name)
        except ValueError as refusal:
            raise NodeError(f"name = {refusal}") from None

    def _check_topics(self) -> None:
        for name in self._chosen:
            try:
                self.resolve_topic_name(name)
            except RCLError as refusal:
                reason = str(refusal).partition(", at ")[0]
                raise NodeError(f"topics: {brief(name)}: {reason}") from None

    def _discover(self) -> None:
        names = wanted_topics(self, self._chosen)
        found = [name for name in names if self._subscribe(name)]
        matched = [name for name, tap in self._taps.items() if tap.publishers]
        if found or matched != self._status.topics:
            self._publish_status()

    def _subscribe(self, name: str) -> bool:
        """Begin recording `name`; false where that is done, or cannot be done."""
        tap = self._taps.get(name)
        publishers = self.get_publishers_info_by_topic(name)
        if name in self._refused or not publishers or (tap and tap.subscription):
            return False
        try:
            topic = describe(name, publishers)
            kind = message_class(topic.type)
        except (ImportError, FileNotFoundError) as missing:
            self._refused.add(name)
            self.get_logger().warning(f"{name} is not recorded: {missing}")
            return False
        qos = matching_qos(publishers)
        if tap is None:
            latched = qos.durability == DurabilityPolicy.TRANSIENT_LOCAL
            tap = self._taps[name] = Tap(self._bag, self._bag.add_topic(topic), latched)
        tap.subscription = self.create_subscription(
            kind,
            name,
            tap.receive,
            qos,
            raw=True,
            event_callbacks=SubscriptionEventCallbacks(message_lost=tap.told_of_loss),
        )
        return True

    def _flush(self) -> None:
        self._bag.flush()

    def _publish_status(self) -> None:
        status = self._status
        set_stamp(status.header.stamp, self._now.now())
        status.sequence += 1
        status.file = str(self._bag.file)
        status.duration = (time.monotonic_ns() - self._begun) * 1e-9
        status.bytes = self._bag.size
        matched = {name: tap.account for name, tap in self._taps.items() if tap.publishers}
        status.topics = list(matched)
        status.recorded = [account.recorded for account in matched.values()]
        status.lost = [account.lost for account in matched.values()]
        self._status_publisher.publish(status)


def _summary(accounts: dict[str, TopicAccount]) -> str:
    recorded = sum(account.recorded for account in accounts.values())
    losses = ", ".join(f"{name} {a.lost}" for name, a in accounts.items() if a.lost)
    return f"recorded {recorded} messages, lost {losses or 'none'}"


def main(args: list[str] | None = None) -> int:
    """Run the node until it is told to end."""
    return run_node(Logger, args)


if __name__ == "__main__":
    sys.exit(main())
