"""A simulation takes the estimates of a follower: at most once a second, without steps."""

import numpy as np
import pytest
from planetary_twin.follower.simulation_client import RAMP
from planetary_twin_msgs.msg import FollowerEstimate, GearboxState
from planetary_twin_msgs.srv import SetOperatingPoint

import planetary_twin_py as pt

from ..peer import TWIN
from .test_inputs import RATIO, Rig

INTERVAL = 0.01  # [s] of a running simulation


class OtherRig(Rig):
    """A machine at other torque and speed than the scene's."""

    def reading(self, time, scale=None):
        message = super().reading(time, scale)
        message.velocity = [90.0, 90.0 * RATIO]
        message.effort = [50.0, (50.0 - 0.7) / -RATIO]
        return message


def test_a_running_simulation_reaches_what_is_measured(peer, start):
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state")
    start("planetary_twin.simulation")
    peer.until(lambda: states)
    rig = OtherRig(peer)
    start("planetary_twin.follower", twin="simulation")
    rig.wait_for_the_follower()
    rig.send(0.0, 4.0)
    peer.until(lambda: abs(states[-1].input_torque - 50.0) < 0.5)
    peer.until(lambda: abs(states[-1].input_speed - 90.0) < 0.5)


def test_changes_are_at_most_one_a_second_and_not_repeated(peer, start):
    requests: list[SetOperatingPoint.Request] = []

    def answer(
        request: SetOperatingPoint.Request, response: SetOperatingPoint.Response
    ) -> SetOperatingPoint.Response:
        requests.append(request)
        response.success = True
        return response

    peer.node.create_service(SetOperatingPoint, f"{TWIN}/other/set_operating_point", answer)
    rig = Rig(peer)
    start("planetary_twin.follower", twin="other")
    rig.wait_for_the_follower()
    estimates: list[FollowerEstimate] = rig.estimates
    rig.send(0.0, 2.0)
    peer.until(lambda: requests)
    assert list(requests[0].names) == ["input_torque", "input_speed", "oil_temperature"]
    assert requests[0].values[0] == pytest.approx(63.0, abs=0.3) and requests[0].ramp == RAMP
    time = 2.0
    seen = len(estimates)
    while time < 8.0:  # in more than two seconds, so there are several occasions
        rig.send(time, time + 0.1)
        time += 0.1
        target = len(estimates) + 1
        peer.until(lambda target=target: len(estimates) >= target)
    assert len(estimates) > seen + 20
    assert len(requests) == 1  # nothing has changed by 0.5 %


def test_a_ramp_does_not_ring_the_couplings():
    """A step of the torque by 20 % does: by more than ten times as much."""

    def swing(ramp: float) -> float:
        twin = pt.Twin(pt.load_scene("paper"), tolerance=1e-4)
        twin.advance(0.5)
        begin, torques = twin.time, []
        while twin.time < begin + ramp + 0.2:
            share = min((twin.time + INTERVAL - begin) / ramp, 1.0) if ramp else 1.0
            twin.set(input_torque=63.0 * (1.0 - 0.2 * share))
            window = twin.advance(INTERVAL)
            torques.append(window.waveform.mesh_force.sum(axis=1))
        after = np.concatenate(torques[-20:])  # 0.2 s after the change
        kernel = np.ones(100) / 100  # over a mesh cycle of 2 ms at 50 kHz
        slow = np.convolve(after, kernel, "valid")
        return float(slow.max() - slow.min())

    assert swing(RAMP) < 0.1 * swing(0.0)
