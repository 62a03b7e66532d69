"""A replay publishes a recording again: every byte, in order and in time, to all subscribers."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from domains import private_domain
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from mcap.reader import make_reader
from planetary_twin.base.topics import message_class
from planetary_twin_msgs.msg import GearboxState
from rosbags.rosbag2 import Reader, StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from std_msgs.msg import String
from std_srvs.srv import SetBool

from planetary_twin_py.recording.ros2.bag import BagWriter
from planetary_twin_py.recording.ros2.metadata import Topic

from ..peer import TWIN, Peer
from ..processes import holding
from ..programs import Program, ended, outcome

COMMAND = Path(sys.executable).with_name("planetary-twin")


@pytest.fixture(scope="module")
def bag(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A recording of one second, made by the nodes."""
    place = tmp_path_factory.mktemp("replay")
    command = [COMMAND, "run", "--duration", "1", "--record", "bag"]
    with private_domain() as number:
        environment = os.environ | {"ROS_DOMAIN_ID": str(number)}
        subprocess.run(command, cwd=place, env=environment, check=True, capture_output=True)
    return place / "recordings/bag"


def _recorded(file: Path) -> dict[str, list[tuple[int, bytes]]]:
    """Log times and bytes by topic, read by MCAP's own reader."""
    recorded: dict[str, list[tuple[int, bytes]]] = {}
    with file.open("rb") as stream:
        for _, channel, message in make_reader(stream).iter_messages():
            recorded.setdefault(channel.topic, []).append((message.log_time, message.data))
    return recorded


def _receive(peer: Peer, bag: Path) -> dict[str, list[tuple[int, bytes]]]:
    """Reception times and bytes by topic, appended while the peer runs."""
    received: dict[str, list[tuple[int, bytes]]] = {}
    with Reader(bag) as reader:
        kinds = {connection.topic: connection.msgtype for connection in reader.connections}
    for topic, kind in kinds.items():
        got = received[topic] = []

        def take(raw: bytes, info: dict[str, Any], got: list[tuple[int, bytes]] = got) -> None:
            got.append((info["received_timestamp"], raw))

        peer.node.create_subscription(message_class(kind), topic, take, 1000, raw=True)
    return received


def _end(process: Program | subprocess.Popen[str], peer: Peer) -> tuple[str, str]:
    """Its output; the peer continues to receive while it ends."""
    peer.until(lambda: process.poll() is not None)
    return outcome(process)


def _resume(peer: Peer) -> None:
    """Resume a replay that started paused.

    It can answer only when it has discovered all subscriptions that the peer made before.
    """
    answer = peer.call(SetBool, f"{TWIN}/replay/pause", SetBool.Request(data=False))
    assert answer.success, answer.message


def refused(process: Program, *reasons: str) -> None:
    errors = ended(process, 2)
    assert errors.startswith("planetary-twin: ")
    assert len(errors.strip().splitlines()) == 1
    assert all(reason in errors for reason in reasons), errors


def test_every_message_is_replayed_byte_for_byte_in_time(peer, play, bag):
    recorded = _recorded(bag / "bag_0.mcap")
    begin = min(messages[0][0] for messages in recorded.values())
    received = _receive(peer, bag)
    process = play(bag, "--start-paused")
    resumed = time.time_ns()
    _resume(peer)
    _end(process, peer)
    peer.until(lambda: all(len(received[name]) == len(recorded[name]) for name in recorded))
    for name, messages in recorded.items():
        assert [data for _, data in received[name]] == [data for _, data in messages]
    names = [name for name in recorded if len(recorded[name]) > 50]
    assert len(names) == 4
    for name in names:
        then, now = (np.array([t for t, _ in source[name]]) for source in (recorded, received))
        running = then > begin  # the first messages are played while it is paused
        early = (then - begin) - (now - resumed)
        assert early[running].max() < 0.0  # the delay depends on the machine


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_it_cleanly_at_any_moment(peer, domain, bag, number):
    words = [COMMAND, "replay", bag, "--rate-factor", "0.1"]
    pipe = subprocess.PIPE
    process = subprocess.Popen(words, stdout=pipe, stderr=pipe, text=True)
    # Earlier, Python has not read the command yet.
    peer.until(lambda: holding(process.pid, "_rclpy"))
    process.send_signal(number)
    _end(process, peer)


def test_a_live_twin_on_the_same_topics_causes_a_warning(peer, play, bag):
    other = peer.node.create_publisher(GearboxState, f"{TWIN}/gearbox_state", 10)
    output, _ = _end(play(bag, "--rate-factor", "10"), peer)
    peer.node.destroy_publisher(other)
    assert f"other publishers exist, subscribers receive both: {TWIN}/gearbox_state\n" in output


def test_the_node_runs_without_the_command_and_pauses(peer, start, bag):
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state", 1000)
    process = start("planetary_twin.replay", file=bag, rate_factor=0.25)
    peer.until(lambda: len(states) > 10)

    def change(label: str) -> None:
        request = ChangeState.Request(transition=Transition(label=label))
        assert peer.call(ChangeState, f"{TWIN}/replay/change_state", request).success

    change("deactivate")
    held = len(states)
    assert held < 100
    change("activate")
    _end(process, peer)
    count = len(_recorded(bag / "bag_0.mcap")[f"{TWIN}/gearbox_state"])
    peer.until(lambda: len(states) == count)
    assert [state.sequence for state in states] == list(range(1, count + 1))


def test_a_bag_of_another_recorder_is_played(peer, play, tmp_path):
    _foreign(tmp_path / "bag", "std_msgs/msg/String", "string data")
    received = peer.listen(String, "/chatter")
    _end(play(tmp_path / "bag"), peer)
    peer.until(lambda: len(received) == 3)


def test_unplayable_recordings_end_in_one_line(play, bag, tmp_path):
    (tmp_path / "text").write_text("no recording")
    (tmp_path / "empty").mkdir()
    refused(play("nowhere"), "nowhere: no such file")
    refused(play("text"), "text: not a recording")
    refused(play("empty"), "empty: not a recording")
    refused(play(bag, "--start", "99"), "start = 99", "s long")


def test_a_message_type_that_is_not_installed_ends_in_one_line(play, tmp_path):
    _foreign(tmp_path / "bag", "foreign_msgs/msg/Odd", "string data")
    refused(play("bag"), "/chatter", "foreign_msgs/msg/Odd is not installed")


def test_another_version_of_a_message_type_ends_in_one_line(play, tmp_path):
    bag = BagWriter(tmp_path / "bag")
    topic = Topic("/chatter", "std_msgs/msg/String", "RIHS01_" + "0" * 64, "string other")
    bag.write(bag.add_topic(topic), b"\0\1\0\0\1\0\0\0\0", 1, 1, 1)
    bag.close()
    refused(play("bag"), "/chatter", "another version of std_msgs/msg/String")


def _foreign(folder: Path, kind: str, definition: str) -> None:
    """A bag written by rosbags, with three messages of the given type."""
    types = get_typestore(Stores.EMPTY)
    types.register(get_types_from_msg(definition, kind))
    with Writer(folder, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connection = writer.add_connection("/chatter", kind, typestore=types)
        texts = [""] * len(definition.splitlines())
        data = types.serialize_cdr(types.types[kind](*texts), kind)
        for k in range(3):
            writer.write(connection, 1_000_000_000 + 10_000_000 * k, data)
