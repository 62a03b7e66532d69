"""The follower with readings that are late, doubled, missing, wrong, or of another machine."""

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from planetary_twin_msgs.msg import EncoderBlock, FollowerEstimate
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import JointState, Temperature
from std_srvs.srv import Trigger

from ..conftest import Start
from ..peer import TWIN, Peer
from ..reported import statuses

FOLLOWER = f"{TWIN}/follower"
JOINTS = f"{TWIN}/measured/joint_states"
RATIO = -20 * 30 / (20 * 70)  # of the teeth of scene `paper`, carrier held
BEGIN = 1_000_000_000.0  # [s] first stamp
RATE = 100.0  # [Hz]


class Rig:
    """Publishes readings of a machine in steady running, and hears what the follower says."""

    def __init__(self, user: Peer) -> None:
        self.user = user
        create = user.node.create_publisher
        self.joints: Publisher = create(JointState, JOINTS, 2000)
        self.oil: Publisher = create(Temperature, f"{TWIN}/measured/oil_temperature", 100)
        self.encoders: Publisher = create(EncoderBlock, f"{TWIN}/measured/encoders", 100)
        self.estimates: list[FollowerEstimate] = user.listen(
            FollowerEstimate, f"{FOLLOWER}/estimate"
        )
        self.reports: list[DiagnosticArray] = user.listen(DiagnosticArray, "/diagnostics")
        self._noise = np.random.default_rng(0)

    def wait_for_the_follower(self) -> None:
        """Wait until it hears every topic reliably, so that nothing is lost."""
        publishers = (self.joints, self.oil, self.encoders)
        self.user.until(lambda: all(map(self.is_matched, publishers)))

    def is_matched(self, publisher: Publisher, subscribers: int = 1) -> bool:
        """
        Whether all subscriptions are reliable, to which they change for such a publisher.

        While a subscriber has two, the publisher may not know the reliable one yet.
        """
        ends = self.user.node.get_subscriptions_info_by_topic(publisher.topic_name)
        reliable = [e.qos_profile.reliability == ReliabilityPolicy.RELIABLE for e in ends]
        matched = publisher.get_subscription_count() == subscribers
        return matched and reliable == [True] * subscribers

    def reading(self, time: float, scale: dict[str, float] | None = None) -> JointState:
        """A reading at a time [s] after the first, with other units by `scale`."""
        factors = {"torque": 1.0, "speed": 1.0, "output_speed": 1.0} | (scale or {})
        noise = self._noise.standard_normal(2)
        message = JointState(name=["input_joint", "output_joint"])
        stamp(message, BEGIN + time)
        message.velocity = [104.72 * factors["speed"], 104.72 * RATIO * factors["output_speed"]]
        driven = -(63.0 - 0.8) / RATIO
        message.effort = [63.0 + 0.1 * noise[0], factors["torque"] * (driven + 0.25 * noise[1])]
        return message

    def send(self, begin: float, end: float, **scale: float) -> None:
        """Publish the readings between two times [s]."""
        for n in range(round(begin * RATE), round(end * RATE)):
            self.joints.publish(self.reading(n / RATE, scale))

    def reported(self, report: str, level: bytes, words: str = "") -> DiagnosticStatus:
        """The first report of this level with these words."""

        def found() -> list[DiagnosticStatus]:
            named = statuses(self.reports, f"follower: {report}")
            return [s for s in named if s.level == level and words in s.message]

        return self.user.until(found)[0]

    def counters(self, until: Callable[[dict[str, int]], bool]) -> dict[str, int]:
        """Counters of the readings, once they fulfil a condition."""

        def found() -> list[dict[str, int]]:
            reports = statuses(self.reports, "follower: inputs")
            counted = [{item.key: int(item.value) for item in each.values} for each in reports]
            return [counts for counts in counted if counts and until(counts)]

        return self.user.until(found)[0]


def stamp(message: Any, time: float) -> None:
    whole, part = divmod(round(time * 1e9), 1_000_000_000)
    message.header.stamp.sec, message.header.stamp.nanosec = whole, part


@pytest.fixture
def rig(peer: Peer) -> Iterator[Rig]:
    yield Rig(peer)


def begin(start: Start, rig: Rig, **given: Any) -> None:
    start("planetary_twin.follower", **given)
    rig.wait_for_the_follower()


def test_spoilt_readings_are_counted_and_not_used(rig, start):
    begin(start, rig)
    rig.send(0.0, 3.0)
    late, doubled, early = rig.reading(1.0), rig.reading(2.995), rig.reading(500.0)
    missing, wild = rig.reading(3.001), rig.reading(3.002)
    missing.effort = [math.nan, math.nan]
    wild.effort = [900.0, 145.0]
    empty = rig.reading(3.003)
    empty.velocity = []
    for message in (late, doubled, doubled, missing, wild, empty, early):
        rig.joints.publish(message)
    order = [3.05, 3.03, 3.04, 3.02, 3.01]  # out of order, within 0.2 s
    for time in order:
        rig.joints.publish(rig.reading(time))
    rig.send(3.06, 7.0)
    counts = rig.counters(lambda c: c["used"] > 4 * 640)
    assert counts["late"] == 4 and counts["doubled"] == 4  # a message has four channels
    assert counts["missing"] == 2 and counts["outlying"] == 1 and counts["ahead"] == 1
    last = rig.user.until(lambda: rig.estimates and rig.estimates[-1])
    assert last.input_torque == pytest.approx(63.0, abs=0.2)
    assert last.loss_torque == pytest.approx(0.8, abs=0.2)


def test_another_unit_is_named_and_mended_by_a_parameter(rig, start):
    scale, words = {"output_speed": 30 / math.pi}, "output_speed/input_speed = -4.09"
    begin(start, rig)
    rig.send(0.0, 6.0, **scale)
    found = rig.reported("inputs", DiagnosticStatus.ERROR, words)
    assert "\n" not in found.message
    for transition in ("deactivate", "cleanup"):
        rig.user.change_state(FOLLOWER, transition)
    assert rig.user.set(FOLLOWER, **{"scale.output_speed": math.pi / 30}).successful
    for transition in ("configure", "activate"):
        rig.user.change_state(FOLLOWER, transition)
    rig.wait_for_the_follower()
    rig.estimates.clear()
    rig.send(10.0, 16.0, **scale)
    rig.user.until(lambda: rig.estimates and rig.estimates[-1].input_torque_status == "ESTIMATED")


def test_silence_makes_estimates_stale(rig, start):
    begin(start, rig, sensor_timeout=0.5)
    rig.send(0.0, 3.0)
    stale = rig.user.until(
        lambda: [one for one in rig.estimates if one.input_torque_status == "STALE"]
    )
    assert stale[0].input_torque == pytest.approx(63.0, abs=0.2)
    rig.reported("inputs", DiagnosticStatus.STALE, "no readings for")
    rig.estimates.clear()
    rig.send(3.0, 5.0)
    rig.user.until(lambda: rig.estimates and rig.estimates[-1].input_torque_status == "ESTIMATED")


@pytest.mark.parametrize("restarts", [False, True])
def test_stamps_that_jump_back_are_reported(rig, start, restarts):
    begin(start, rig, reset_on_time_jump=restarts)
    rig.send(100.0, 103.0)
    rig.user.until(lambda: rig.estimates and rig.estimates[-1].header.stamp.sec >= BEGIN + 102)
    rig.send(0.0, 3.0)
    rig.reported("clock", DiagnosticStatus.WARN, "stamps have jumped back 1 times")
    if restarts:
        rig.user.until(lambda: rig.estimates[-1].header.stamp.sec < BEGIN + 100)
    else:
        rig.counters(lambda c: c["late"] == 4 * 300)
        assert rig.estimates[-1].header.stamp.sec >= BEGIN + 100


def test_several_publishers_of_one_sensor_are_a_warning(start, rig):
    """Those of joints are none: each may publish other joints."""
    begin(start, rig)
    second = rig.user.node.create_publisher(EncoderBlock, f"{TWIN}/measured/encoders", 100)
    another = rig.user.node.create_publisher(JointState, JOINTS, 100)
    rig.send(0.0, 3.0)
    words = f"several publishers, must be one sensor: {TWIN}/measured/encoders"
    report = rig.reported("inputs", DiagnosticStatus.WARN, words)
    assert JOINTS not in report.message
    rig.user.node.destroy_publisher(second)
    rig.reports.clear()
    rig.reported("inputs", DiagnosticStatus.STALE, "no readings for")
    rig.user.node.destroy_publisher(another)


def test_a_reset_forgets_all_readings(rig, start):
    begin(start, rig)
    rig.send(100.0, 103.0)
    last = rig.reading(103.0)
    last.effort = [math.nan, math.nan]
    rig.joints.publish(last)
    rig.counters(lambda c: c["missing"] == 2)  # so all readings before it have been taken
    rig.user.until(lambda: rig.estimates and rig.estimates[-1].header.stamp.sec >= BEGIN + 102)
    assert rig.user.call(Trigger, f"{FOLLOWER}/reset", Trigger.Request()).success
    rig.user.until(lambda: rig.estimates[-1].input_torque_status == "LEARNING")
    rig.send(0.0, 3.0)  # which would be late otherwise
    rig.user.until(lambda: rig.estimates[-1].input_torque_status == "ESTIMATED")
    assert rig.estimates[-1].header.stamp.sec < BEGIN + 100


def test_publishers_that_are_best_effort_are_received_too(peer, start):
    qos = QoSProfile(depth=2000, reliability=ReliabilityPolicy.BEST_EFFORT)
    rig = Rig(peer)
    peer.node.destroy_publisher(rig.joints)
    rig.joints = peer.node.create_publisher(JointState, JOINTS, qos)
    start("planetary_twin.follower")
    peer.until(lambda: rig.joints.get_subscription_count() == 1)
    time = 0.0

    def estimated() -> bool:
        nonlocal time
        rig.send(time, time + 0.1)
        time += 0.1
        return bool(rig.estimates and rig.estimates[-1].input_torque_status == "ESTIMATED")

    peer.until(estimated)


def test_parameters_are_refused_in_one_line(rig, start):
    start("planetary_twin.follower", autostart="false")
    for name, value, words in (
        ("period", 0.001, "within 0.01 and 60"),
        ("publish_rate", 1e4, "within 0.1 and 100"),
        ("tooth_limit", 2.0, "within 0 and 1"),
    ):
        refused = rig.user.set(FOLLOWER, **{name: value})
        assert not refused.successful and refused.reason.startswith(f"{name} = {value!r}")
        assert words in refused.reason
    assert rig.user.set(FOLLOWER, sensors="none.yaml").successful
    process = start(
        "planetary_twin.follower", "--ros-args", "-r", "__ns:=/other", sensors="none.yaml"
    )
    _, errors = process.communicate(timeout=120)
    assert errors.strip().splitlines()[-1] == (
        "follower: sensors = 'none.yaml': No such file or directory"
    )
