"""Simulated time is paused, stepped and reset, and subscribers can follow it."""

import itertools
import math
import time

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from planetary_twin_msgs.msg import GearboxState, MeshWaveform, OperatingPoint
from planetary_twin_msgs.srv import NaturalModes, Step
from rclpy.parameter import Parameter
from rclpy.time import Time
from rosgraph_msgs.msg import Clock
from std_srvs.srv import Trigger

import planetary_twin_py as pt

from ..conftest import Start
from ..peer import LATCHED, TWIN, Peer
from ..reported import check_rising

NODE = f"{TWIN}/simulation"
INTERVAL = 0.01  # [s]


class Received:
    """Messages of a running simulation since the first one."""

    def __init__(self, peer: Peer) -> None:
        self.states = peer.listen(GearboxState, f"{TWIN}/gearbox_state")
        self.waves = peer.listen(MeshWaveform, f"{TWIN}/mesh_waveform")
        self.points = peer.listen(OperatingPoint, f"{TWIN}/operating_point", LATCHED)
        peer.until(lambda: self.states and self.points)

    def check(self) -> None:
        check_rising(self.states, self.waves)


class Follower:
    """A node with `use_sim_time`, and the times at which its clock changed."""

    def __init__(self, peer: Peer) -> None:
        peer.node.set_parameters([Parameter("use_sim_time", value=True)])
        self._clock = peer.node.get_clock()
        self._seen: dict[int, float] = {}

    def pace(self, ticks: int = 40) -> float:
        """Seconds of its clock per second over the newest `ticks`; NaN before there are any."""
        now = self._clock.now().nanoseconds
        if now:  # before the first /clock there is no time
            self._seen.setdefault(now, time.monotonic())
        instants = list(self._seen.items())[-ticks - 1 :]
        if len(instants) <= ticks:
            return math.nan
        (first, begin), (last, end) = instants[0], instants[-1]
        return (last - first) * 1e-9 / (end - begin)


@pytest.fixture
def received(peer: Peer, start: Start) -> Received:
    start("planetary_twin.simulation")
    return Received(peer)


def step(peer: Peer, duration: float) -> Step.Response:
    return peer.call(Step, f"{NODE}/step", Step.Request(duration=duration))


def stand(peer: Peer, states: list[GearboxState]) -> float:
    """Pause; returns the simulated time [s] after all earlier messages have arrived."""
    word, *_, instant, unit = peer.pause(NODE).split()
    assert (word, unit) == ("paused", "s")
    held = float(instant)
    peer.until(lambda: states[-1].simulated_time == pytest.approx(held, abs=1e-6))
    return held


def test_a_paused_twin_resumes_at_the_same_time(peer, received):
    stand(peer, received.states)
    stood = len(received.states)
    reports = peer.listen(DiagnosticArray, "/diagnostics")

    def paused() -> list[DiagnosticArray]:
        return [r for r in reports if any(v.value == "paused" for v in r.status[0].values)]

    peer.until(lambda: len(paused()) >= 2)  # a second apart
    assert len(received.states) == stood
    assert all(ord(report.status[0].level) == 0 for report in paused())
    peer.pause(NODE, False)
    peer.until(lambda: len(received.states) > stood + 20)
    times = [state.simulated_time for state in received.states]
    assert all(math.isclose(b - a, INTERVAL, abs_tol=1e-9) for a, b in itertools.pairwise(times))
    received.check()


def test_a_step_of_a_paused_twin_has_the_requested_duration(peer, received):
    before, count = stand(peer, received.states), len(received.states)
    for duration, messages in ((INTERVAL, 1), (0.025, 3), (1e-6, 1)):
        answer = step(peer, duration)
        assert answer.success, answer.message
        assert answer.simulated_time == pytest.approx(before + duration, abs=1e-9)
        count += messages
        peer.until(lambda n=count: len(received.states) == n)
        assert received.states[-1].simulated_time == answer.simulated_time
        assert received.states[-1].header.stamp == answer.stamp
        before = answer.simulated_time
    received.check()


def test_steps_of_a_running_twin_and_invalid_ones_are_refused(peer, received):
    answer = step(peer, 0.1)
    assert not answer.success and "pause it first" in answer.message
    peer.pause(NODE)
    for duration in (0.0, -1.0, math.nan, 1e9):
        answer = step(peer, duration)
        assert not answer.success
        assert answer.message.startswith("duration = ")


def test_a_reset_starts_again_with_the_parameters_in_force(peer, received):
    assert peer.set(NODE, backlash=3e-7).successful
    peer.until(lambda: len(received.points) == 2 and received.states[-1].simulated_time > 0.3)
    assert peer.call(Trigger, f"{NODE}/reset", Trigger.Request()).success
    peer.until(lambda: len(received.points) == 3)
    assert received.points[-1].simulated_time == 0.0 and received.points[-1].backlash == 3e-7
    peer.until(
        lambda: any(
            a.simulated_time > b.simulated_time for a, b in itertools.pairwise(received.states)
        )
    )
    first = next(
        b for a, b in itertools.pairwise(received.states) if a.simulated_time > b.simulated_time
    )
    assert first.simulated_time == pytest.approx(INTERVAL)
    received.check()
    assert peer.set(NODE, backlash=2e-7).successful
    peer.until(lambda: received.points[-1].backlash == 2e-7)


def test_the_clock_has_the_time_of_the_messages(peer, start):
    # Launch files set `use_sim_time` for all nodes: the source must not wait for itself.
    start("planetary_twin.simulation", clock="true", use_sim_time="true", rate_factor=0.1)
    clocks = peer.listen(Clock, "/clock")
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state")
    follower = Follower(peer)
    # A loaded machine may delay the twin for a while.
    peer.until(lambda: follower.pace() == pytest.approx(0.1, rel=0.05))
    stand(peer, states)
    peer.pause(NODE, False)
    stood = len(clocks)
    peer.until(lambda: len(clocks) > stood + 2)
    stamps = {Time.from_msg(state.header.stamp).nanoseconds for state in states}
    times_of_clock = [Time.from_msg(clock.clock).nanoseconds for clock in clocks]
    # Simulated time does not jump after a pause.
    for before, after in itertools.pairwise(times_of_clock):
        assert (after - before) * 1e-9 == pytest.approx(INTERVAL, abs=1e-6)
    assert len(stamps & set(times_of_clock)) >= 20


def test_natural_modes_are_those_of_the_scene(peer, received):
    answer = peer.call(NaturalModes, f"{NODE}/natural_modes", NaturalModes.Request())
    modes = pt.natural_modes(pt.load_scene("paper"))
    assert list(answer.frequencies) == pytest.approx(list(modes.frequencies))
    assert list(answer.kinds) == list(modes.kinds)
