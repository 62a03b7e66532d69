"""What a live follower says does not depend on when its thread takes messages."""

import itertools
import threading
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from planetary_twin.follower.live_follower import LiveFollower
from planetary_twin.follower.parameters import Followed
from sensor_msgs.msg import JointState, Temperature

import planetary_twin_py as pt
from planetary_twin_py.following.channels.message_types import JOINTS, TEMPERATURE
from planetary_twin_py.following.measured.messages import Arrived
from planetary_twin_py.following.sensors import JointNames
from planetary_twin_py.following.state import Following

from .test_inputs import BEGIN, RATE, RATIO, stamp

DURATION = 8.0  # [s]


class Taken:
    """Messages that wait in portions; each portion is taken at once."""

    def __init__(self, portions: list[list[Arrived]]) -> None:
        self._portions = portions
        self.empty = threading.Event()

    def follow_publishers(self) -> None:
        """There are none."""

    def take(self) -> list[Arrived]:
        if not self._portions:
            self.empty.set()
            return []
        return self._portions.pop(0)


class Received:
    """Keeps what is reported."""

    def __init__(self) -> None:
        self.followings: list[Following] = []
        self.faults: list[object] = []

    def started(self) -> None:
        self.followings.clear()

    def estimated(self, following: Following) -> None:
        self.followings.append(following)

    def refused(self, reason: str) -> None:
        self.faults.append(reason)

    def jumped(self, seconds: float) -> None:
        self.faults.append(seconds)

    def stopped(self, defect: Exception) -> None:
        self.faults.append(defect)


def messages() -> list[Arrived]:
    """Readings of both shafts and of the oil, in the order of their stamps."""
    noise = np.random.default_rng(0).standard_normal((round(DURATION * RATE), 2))
    found = []
    for n, (first, second) in enumerate(noise.tolist()):
        reading = JointState(name=["input_joint", "output_joint"])
        reading.velocity = [104.72, 104.72 * RATIO]
        reading.effort = [63.0 + 0.1 * first, -(63.0 - 0.8) / RATIO + 0.25 * second]
        found.append(arrived("joints", JOINTS[0], reading, n / RATE))
        if n % round(RATE) == 0:
            oil = Temperature(temperature=60.0 + 0.1 * n / RATE)
            found.append(arrived("oil", TEMPERATURE, oil, n / RATE))
    return found


def arrived(sender: str, kind: str, message: JointState | Temperature, time: float) -> Arrived:
    stamp(message, BEGIN + time)
    return Arrived(sender, kind, BEGIN + time, message)


def estimates_of(portions: list[list[Arrived]]) -> list[Following]:
    """Estimates from these portions."""
    settings = SimpleNamespace(publish_rate=10.0, sensor_timeout=3600.0, reset_on_time_jump=False)
    followed = Followed(pt.load_scene("paper"), pt.Sensors(), JointNames(), {}, 0.1, None)
    source, received = Taken(portions), Received()
    live = LiveFollower(followed, settings, source, received)
    assert source.empty.wait(120.0)
    live.stop()
    assert received.faults == []
    return received.followings


@pytest.fixture(scope="module")
def at_once() -> list[Following]:
    return estimates_of([messages()])


def test_messages_taken_at_once_give_every_estimate(at_once):
    times = [one.time - BEGIN for one in at_once]
    assert np.diff(times[:-1]) == pytest.approx(0.1, abs=1e-6)
    assert times[0] < 2.0 and times[-1] == pytest.approx(DURATION, abs=1e-6)


@pytest.mark.parametrize("seed", range(3))
def test_estimates_are_the_same_however_messages_are_taken(at_once, seed):
    every = messages()
    cuts = np.sort(np.random.default_rng(seed).choice(len(every), 12, replace=False))
    ends = [0, *cuts.tolist(), len(every)]
    found = estimates_of([every[a:b] for a, b in itertools.pairwise(ends)])
    assert repr(found) == repr(at_once)


@pytest.mark.parametrize("late", ["joints", "oil"])
def test_estimates_are_the_same_if_one_topic_is_late(at_once, late):
    def place(one: Arrived) -> float:
        return one.time + 0.5 * (one.sender == late)

    found = estimates_of([sorted(messages(), key=place)])
    assert repr(estimated(found)) == repr(estimated(at_once))


def estimated(followings: list[Following]) -> list[Following]:
    """All but the counters, which count what has arrived."""
    return [replace(one, counters={}) for one in followings]
