"""Stamps increase strictly if clocks jump or stop; without a clock no state is published."""

import itertools
import time

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from planetary_twin.base.clock import STEADY
from planetary_twin.base.diagnostics import real_time_figures
from planetary_twin_msgs.msg import GearboxState, MeshWaveform, OperatingPoint
from planetary_twin_msgs.srv import Step
from rclpy.time import Time
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger

from ...peer import LATCHED, TWIN, Peer, seconds
from ...reported import check_rising, check_verified

MODULE = "planetary_twin.simulation"
INTERVAL = 0.01  # [s]
HOUR = 3600.0  # [s]


class Ticking:
    """A /clock from another publisher, which the test can set."""

    def __init__(self, peer: Peer, begin: float) -> None:
        self._ahead = begin - time.monotonic()
        self._publisher = peer.node.create_publisher(Clock, "/clock", 10)
        peer.node.create_timer(0.01, self._tick, clock=STEADY)

    def _tick(self) -> None:
        self._publisher.publish(Clock(clock=Time(nanoseconds=round(self.now * 1e9)).to_msg()))

    @property
    def now(self) -> float:
        return time.monotonic() + self._ahead

    def jump(self, by: float) -> None:
        self._ahead += by


def figures(reports: list[DiagnosticArray]) -> dict[str, str]:
    """Values of the newest report."""
    return real_time_figures(reports[-1], TWIN) if reports else {}


def test_stamps_increase_when_an_external_clock_jumps(peer, start):
    start(MODULE, use_sim_time="true")
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state", 1000)
    waves = peer.listen(MeshWaveform, f"{TWIN}/mesh_waveform", 1000)
    reports = peer.listen(DiagnosticArray, "/diagnostics")
    peer.until(lambda: figures(reports).get("state") == "waits")
    assert not states

    clock = Ticking(peer, 5.0)

    def follows() -> bool:
        return states and abs(seconds(states[-1].header.stamp) - clock.now) < 0.5

    peer.until(follows)
    assert seconds(states[0].header.stamp) >= 5.0
    clock.jump(2 * HOUR)
    peer.until(follows)
    newest, received = seconds(states[-1].header.stamp), len(states)
    clock.jump(-HOUR)
    peer.until(lambda: len(states) > received + 100)
    # They continue from the newest stamp: they neither stop nor follow the clock back.
    assert newest + 0.5 < seconds(states[-1].header.stamp) < newest + 30.0
    check_rising(states, waves)
    stamps = [Time.from_msg(report.header.stamp) for report in reports]
    assert all(after > before for before, after in itertools.pairwise(stamps))


def test_a_twin_as_fast_as_possible_is_never_late(peer, start):
    start(MODULE, rate_factor=0, sample_rate=5000)
    reports = peer.listen(DiagnosticArray, "/diagnostics")
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state", 1000)
    peer.until(lambda: states)
    begin = seconds(states[0].header.stamp)

    def running() -> list[DiagnosticArray]:  # on a busy machine, the first report is of the start
        return [each for each in reports if seconds(each.header.stamp) > begin]

    peer.until(lambda: len(running()) > 2)
    assert {report.status[0].message for report in running()} == {"runs as fast as possible"}
    reported = figures(reports)
    assert float(reported["real_time_factor"]) > 0.0
    assert int(reported["overruns"]) == 0
    for state in states:
        assert state.simulated_time == pytest.approx(state.sequence * INTERVAL)


NODE = f"{TWIN}/simulation"
NO_CLOCK = "use_sim_time: the twin waits for the first message on /clock"


def step(peer: Peer) -> Step.Response:
    return peer.call(Step, f"{NODE}/step", Step.Request(duration=0.05))


def test_steps_before_the_first_clock_are_refused(peer, start, tmp_path):
    logger = start("planetary_twin.logger", name="clockless")
    start("planetary_twin.simulation", use_sim_time="true", wait_for="logger")
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state")
    points = peer.listen(OperatingPoint, f"{TWIN}/operating_point", LATCHED)
    peer.pause(NODE)
    assert peer.set(NODE, input_torque=80.0).successful
    for _ in range(2):
        refused = step(peer)
        assert not refused.success and refused.simulated_time == 0.0
        assert refused.message == f"{NO_CLOCK}; step the twin then"
        assert (refused.stamp.sec, refused.stamp.nanosec) == (0, 0)  # no time yet
        assert peer.call(Trigger, f"{NODE}/reset", Trigger.Request()).success
    assert not states and not points
    Ticking(peer, 5.0)
    peer.until(lambda: step(peer).success)
    peer.until(lambda: len(states) == 5 and points)
    assert points[-1].input_torque == 80.0
    assert states[0].header.stamp.sec >= 5
    check_verified(logger, tmp_path / "recordings/clockless")


def test_a_plant_begins_with_the_first_clock(peer, start):
    measured = peer.listen(JointState, f"{TWIN}/measured/joint_states")
    plant = start("planetary_twin.plant", use_sim_time="true", duration=0.5)
    assert peer.state(f"{TWIN}/plant") == "active"
    Ticking(peer, 5.0)
    peer.until(lambda: plant.poll() is not None)
    assert measured and measured[0].header.stamp.sec >= 5
