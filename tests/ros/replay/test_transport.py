"""A replay is paused, stepped, moved and changed in rate; its clock follows."""

import itertools
import math
import signal
from pathlib import Path

import numpy as np
import pytest
from builtin_interfaces.msg import Time
from planetary_twin.base.qos import to_words
from planetary_twin_msgs.msg import GearboxState, OperatingPoint
from planetary_twin_msgs.srv import Seek, Step
from rclpy.qos import QoSProfile
from rclpy.serialization import serialize_message
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState

from planetary_twin_py.recording.ros2.bag import BagWriter
from planetary_twin_py.recording.ros2.metadata import Topic
from planetary_twin_py.recording.ros2.schema import message_definition

from ..peer import LATCHED, TWIN, Peer
from ..programs import outcome

NODE = f"{TWIN}/replay"
PERIOD = 10_000_000  # [ns] between two states
BEGIN = 1_790_000_000_000_000_000  # log time of the first message
STAMPED = 1_000_000_000_000  # its stamp, from another clock
LENGTH = 2000  # states, in two files
POINTS = 500  # states between two operating points
DEPTH = 200  # states kept for a subscriber that a busy machine delays


@pytest.fixture(scope="module")
def split(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A recording of 20 s in a folder of two files."""
    place = tmp_path_factory.mktemp("split")
    folder = place / "bag"
    folder.mkdir()
    for n in range(2):
        steps = range(n * LENGTH // 2, (n + 1) * LENGTH // 2)
        _write(place / f"part_{n}", steps).rename(folder / f"bag_{n}.mcap")
    return folder


def _write(place: Path, steps: range, depth: int = DEPTH) -> Path:
    bag = BagWriter(place)
    states = bag.add_topic(_topic("gearbox_state", "GearboxState", QoSProfile(depth=depth)))
    latched = QoSProfile(depth=1, durability=LATCHED.durability)
    points = bag.add_topic(_topic("operating_point", "OperatingPoint", latched))
    state, point = GearboxState(planets=3), OperatingPoint()
    for k in steps:
        now = BEGIN + k * PERIOD
        for channel, message in ((points, point), (states, state)):
            message.sequence, message.simulated_time = k + 1, k * 0.01
            message.header.stamp = Time(sec=1000 + k // 100, nanosec=k % 100 * PERIOD)
            if channel == states or k % POINTS == 0:
                bag.write(channel, serialize_message(message), now, now, k + 1)
        if k % 50 == 49:
            bag.flush()
    bag.close()
    return bag.file


def _topic(name: str, kind: str, qos: QoSProfile) -> Topic:
    kind = f"planetary_twin_msgs/msg/{kind}"
    return Topic(f"{TWIN}/{name}", kind, "", message_definition(kind), [to_words(qos)])


def step(peer: Peer, duration: float) -> Step.Response:
    return peer.call(Step, f"{NODE}/step", Step.Request(duration=duration))


def seek(peer: Peer, time: float) -> Seek.Response:
    return peer.call(Seek, f"{NODE}/seek", Seek.Request(time=time))


def numbers(states: list[GearboxState]) -> list[int]:
    return [state.sequence for state in states]


def expect(peer: Peer, states: list[GearboxState], first: int, last: int) -> None:
    """Exactly these messages have been received; the list is then cleared."""
    peer.until(lambda: len(states) > last - first)
    assert numbers(states) == list(range(first, last + 1))
    states.clear()


def test_a_paused_replay_plays_exactly_the_requested_messages(peer, start, split):
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state", 5000)
    points = peer.listen(OperatingPoint, "/elsewhere", LATCHED)
    clock = peer.listen(Clock, "/clock", 5000)
    remap = ("--ros-args", "-r", f"{TWIN}/operating_point:=/elsewhere")
    given = {"file": split, "start_paused": "true", "clock": 100.0}
    process = start("planetary_twin.replay", *remap, **given)
    expect(peer, states, 1, 1)

    reached = step(peer, 0.5)
    assert reached.success and reached.simulated_time == pytest.approx(0.5)
    assert reached.stamp == Time(sec=BEGIN // 10**9, nanosec=500_000_000)
    expect(peer, states, 2, 51)
    for given in ({"command": JointState(name=["a"])}, {"commands": [JointState(name=["a"])]}):
        refused = peer.call(Step, f"{NODE}/step", Step.Request(duration=0.5, **given))
        assert not refused.success and "must be empty" in refused.message
    peer.until(lambda: len(clock) == 51)
    times = [t.clock.sec * 10**9 + t.clock.nanosec for t in clock]
    assert times == [STAMPED + k * PERIOD for k in range(51)]

    # Forward, across the boundary of the files, with the messages latched there.
    points.clear()
    moved = seek(peer, 9.8)
    assert moved.success and moved.time == 9.8
    expect(peer, states, 981, 981)
    assert [point.sequence for point in peer.until(lambda: points)] == [POINTS + 1]
    late = peer.listen(OperatingPoint, "/elsewhere", LATCHED)
    assert [point.sequence for point in peer.until(lambda: late)] == [POINTS + 1]
    assert step(peer, 0.3).success
    expect(peer, states, 982, 1011)
    assert peer.until(lambda: len(points) > 1 and points)[-1].sequence == 2 * POINTS + 1

    # Back.
    points.clear()
    assert seek(peer, 4.0).success
    expect(peer, states, 401, 401)
    assert [point.sequence for point in peer.until(lambda: points)] == [1]

    for wrong in (-0.1, 20.0, math.nan):
        refused = seek(peer, wrong)
        assert not refused.success
        assert refused.message == f"time = {wrong:g} s: must be within 0 and 19.99"
    refused = step(peer, 10.5)
    assert "duration = 10.5 s: must be above 0 and at most 10" in refused.message
    assert not peer.set(NODE, rate_factor=0.001).successful
    assert peer.pause(NODE) == "paused from 4 s"

    # To the end, where it waits until it is resumed.
    assert seek(peer, 19.9).success
    assert step(peer, 1.0).simulated_time == pytest.approx(19.99)
    expect(peer, states, 1991, 2000)
    assert process.poll() is None
    peer.pause(NODE, False)
    peer.until(lambda: process.poll() is not None)
    output, _ = outcome(process)
    assert "Traceback" not in output
    assert not states


def test_a_running_replay_changes_rate_and_position(peer, play, split):
    received: list[tuple[float, float]] = []  # recorded and received [s]
    clock = peer.listen(Clock, "/clock", 5000)
    peer.node.create_subscription(
        GearboxState,
        "/other/gearbox_state",
        lambda message, info: received.append(
            (message.simulated_time, info["received_timestamp"] * 1e-9)
        ),
        5000,
    )
    arguments = ("--namespace", "other", "--topics", f"{TWIN}/gearbox_state", "--clock", "50")
    process = play(split, "--start-offset", "1", "--loop", *arguments)
    peer.until(lambda: len(received) > 50)
    assert "the replay runs; pause it first" in step(peer, 0.1).message
    for rate in (1.0, 4.0, 0.5):
        assert peer.set(NODE, rate_factor=rate).successful
        settled = len(received) + 20
        peer.until(lambda n=settled, r=rate: _pace(received[n:]) == pytest.approx(r, rel=0.05))
    recorded = [time for time, _ in received]
    assert recorded == pytest.approx(1.0 + 0.01 * (np.arange(len(recorded)) % (LENGTH - 100)))
    times = [t.clock.sec * 10**9 + t.clock.nanosec for t in clock]
    steps = np.diff(times)
    assert steps[steps > 0] == pytest.approx(2 * PERIOD)
    assert np.sum(steps <= 0) <= len(recorded) // (LENGTH - 100)  # where the loop starts again

    # A pause keeps the position; a seek changes it, also between passes of the loop.
    held = float(peer.pause(NODE).split()[-2])
    peer.until(lambda: held - 0.0101 <= received[-1][0] <= held + 1e-9)
    count = len(received)
    peer.pause(NODE, False)
    peer.until(lambda: len(received) > count)
    assert received[count][0] == pytest.approx(received[count - 1][0] + 0.01)
    count = len(received)
    assert seek(peer, 19.8).success
    peer.until(lambda: any(b < a for (a, _), (b, _) in itertools.pairwise(received[count:])))
    recorded = [time for time, _ in received[count:]]
    place = recorded.index(pytest.approx(19.8))
    after = np.array(recorded[place : place + 21])
    assert np.round(100 * after[:21]) == pytest.approx([*range(1980, 2000), 100])

    # As fast as possible, and back to a pace.
    assert peer.set(NODE, rate_factor=0).successful
    count = len(received)
    peer.until(lambda: len(received) > count + 3000)
    assert peer.set(NODE, rate_factor="1").successful
    # After the messages in transit.
    peer.until(lambda: _pace(received[-200:]) == pytest.approx(1.0, rel=0.1))
    process.send_signal(signal.SIGINT)
    peer.until(lambda: process.poll() is not None)
    assert "replayed" in outcome(process)[0]


def _pace(messages: list[tuple[float, float]]) -> float:
    """Recorded seconds per second of received messages; NaN for few messages."""
    if len(messages) < 100:
        return math.nan
    recorded, received = np.array(messages).T
    return float(np.polyfit(received, np.unwrap(recorded, period=LENGTH * 0.01 - 1.01), 1)[0])


def test_as_fast_as_possible_reliable_subscribers_receive_all(peer, play, tmp_path):
    file = _write(tmp_path / "shallow", range(LENGTH), depth=5)
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state", LENGTH)
    process = play(file, "--rate", "0")
    peer.until(lambda: process.poll() is not None)
    expect(peer, states, 1, LENGTH)


def test_a_recorded_clock_is_played_alone(peer, play, tmp_path):
    bag = BagWriter(tmp_path / "bag")
    kind = "rosgraph_msgs/msg/Clock"
    channel = bag.add_topic(Topic("/clock", kind, "", message_definition(kind)))
    for k in range(5):
        now = BEGIN + k * PERIOD
        bag.write(channel, serialize_message(Clock(clock=Time(sec=k))), now, now, k)
    bag.close()
    clock = peer.listen(Clock, "/clock")
    process = play("bag", "--clock", "100")
    peer.until(lambda: process.poll() is not None)
    assert "clock = 100: bag contains /clock" in process.communicate()[0]
    peer.until(lambda: len(clock) >= 5)
    assert [message.clock.sec for message in clock] == [0, 1, 2, 3, 4]
