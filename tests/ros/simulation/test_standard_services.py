"""The services of simulation_interfaces control a twin, if that package is installed."""

import pytest
from planetary_twin_msgs.msg import GearboxState

from ..peer import TWIN, Peer

# The wheels of ROS lack it; a ROS installation has it as ros-jazzy-simulation-interfaces.
pytest.importorskip("simulation_interfaces")

from simulation_interfaces.msg import Result, SimulationState, SimulatorFeatures
from simulation_interfaces.srv import (
    GetSimulationState,
    GetSimulatorFeatures,
    ResetSimulation,
    SetSimulationState,
    StepSimulation,
)

NODE = f"{TWIN}/simulation"
OK = Result.RESULT_OK
STOPPED, PLAYING, PAUSED, QUITTING, NO_WORLD = range(5)


def state(peer: Peer) -> int:
    kind = GetSimulationState
    answer = peer.call(kind, f"{NODE}/get_simulation_state", kind.Request())
    assert answer.result.result == OK
    return int(answer.state.state)


def bring(peer: Peer, wanted: int) -> Result:
    request = SetSimulationState.Request(state=SimulationState(state=wanted))
    return peer.call(SetSimulationState, f"{NODE}/set_simulation_state", request).result


def step(peer: Peer, steps: int) -> Result:
    request = StepSimulation.Request(steps=steps)
    return peer.call(StepSimulation, f"{NODE}/step_simulation", request).result


def reset(peer: Peer, scope: int) -> Result:
    request = ResetSimulation.Request(scope=scope)
    return peer.call(ResetSimulation, f"{NODE}/reset_simulation", request).result


def test_time_is_paused_stepped_reset_and_played(peer, start):
    start("planetary_twin.simulation", publish_rate=50)
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state")
    peer.until(lambda: states)
    assert state(peer) == PLAYING
    refused = step(peer, 1)
    assert refused.result == Result.RESULT_OPERATION_FAILED and "pause" in refused.error_message
    assert bring(peer, PAUSED).result == OK
    assert state(peer) == PAUSED
    already = SetSimulationState.Response.ALREADY_IN_TARGET_STATE
    assert bring(peer, PAUSED).result == already

    received, stood = len(states), states[-1].simulated_time
    assert step(peer, 3).result == OK
    peer.until(lambda: states[-1].simulated_time > stood + 0.05)
    assert len(states) == received + 3
    assert states[-1].simulated_time == pytest.approx(stood + 3 / 50)

    assert bring(peer, STOPPED).result == OK
    assert state(peer) == STOPPED
    assert bring(peer, PLAYING).result == OK
    assert state(peer) == PLAYING
    peer.until(lambda: states[-1].simulated_time < stood)

    unsupported = Result.RESULT_FEATURE_UNSUPPORTED
    assert bring(peer, QUITTING).result == unsupported
    assert reset(peer, ResetSimulation.Request.SCOPE_TIME).result == unsupported
    for scope in (ResetSimulation.Request.SCOPE_DEFAULT, ResetSimulation.Request.SCOPE_ALL):
        before = states[-1].simulated_time
        peer.until(lambda before=before: states[-1].simulated_time > before + 0.1)
        reached = states[-1].simulated_time
        assert reset(peer, scope).result == OK
        peer.until(lambda reached=reached: states[-1].simulated_time < reached)

    peer.change_state(NODE, "deactivate")
    assert state(peer) == NO_WORLD
    assert bring(peer, PLAYING).result == Result.RESULT_INCORRECT_STATE


def test_the_reported_features_are_those_offered(peer, start):
    start("planetary_twin.simulation")
    kind = GetSimulatorFeatures
    answer = peer.call(kind, f"{NODE}/get_simulator_features", kind.Request())
    offered = set(answer.features.features)
    assert {SimulatorFeatures.SIMULATION_STATE_PAUSE, SimulatorFeatures.SIMULATION_RESET} <= offered
    assert SimulatorFeatures.SPAWNING not in offered
    assert answer.features.custom_info
