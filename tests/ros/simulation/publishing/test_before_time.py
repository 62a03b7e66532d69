"""No state is published before the operating point that governs it, and none without a clock."""

from __future__ import annotations

from planetary_twin_msgs.msg import GearboxState, OperatingPoint
from planetary_twin_msgs.srv import Step
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger

from ...peer import LATCHED, TWIN, Peer
from ...reported import check_verified
from .test_clocks import Ticking

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


def test_a_clock_without_time_makes_steps_refused(peer, start, tmp_path):
    logger = start("planetary_twin.logger", name="changed")
    start("planetary_twin.simulation", wait_for="logger")
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state")
    points = peer.listen(OperatingPoint, f"{TWIN}/operating_point", LATCHED)
    peer.until(lambda: states and points)
    answer = peer.set(NODE, use_sim_time=True)
    assert answer.successful and answer.reason == NO_CLOCK
    peer.pause(NODE)
    assert peer.set(NODE, input_torque=80.0).successful
    assert step(peer).message.startswith(NO_CLOCK)
    answer = peer.set(NODE, use_sim_time=False)
    assert answer.successful and answer.reason == ""
    assert step(peer).success
    peer.until(lambda: points[-1].input_torque == 80.0)
    check_verified(logger, tmp_path / "recordings/changed")


def test_a_plant_begins_with_the_first_clock(peer, start):
    measured = peer.listen(JointState, f"{TWIN}/measured/joint_states")
    plant = start("planetary_twin.plant", use_sim_time="true", duration=0.5)
    assert peer.state(f"{TWIN}/plant") == "active"
    Ticking(peer, 5.0)
    peer.until(lambda: plant.poll() is not None)
    assert measured and measured[0].header.stamp.sec >= 5
