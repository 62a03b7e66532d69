"""
The services of the standard package simulation_interfaces for a twin's simulated time.

That package is part of ROS 2 Jazzy. It is an optional dependency, because the wheels lack it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ..base.services import executed
from .live.live_twin import LiveTwin
from .progress import State
from .running import RunningSimulation

try:
    from simulation_interfaces.msg import Result, SimulationState, SimulatorFeatures
    from simulation_interfaces.srv import (
        GetSimulationState,
        GetSimulatorFeatures,
        ResetSimulation,
        SetSimulationState,
        StepSimulation,
    )
except ModuleNotFoundError:
    AVAILABLE = False
else:
    AVAILABLE = True


class SimulationServices:
    """
    The services `~/get_simulator_features`, `~/get_simulation_state` and so on of `node`.

    They need `AVAILABLE`. A step is one published interval.
    """

    def __init__(self, node: RunningSimulation) -> None:
        self._node = node
        node.create_service(GetSimulatorFeatures, "~/get_simulator_features", self._features)
        node.create_service(GetSimulationState, "~/get_simulation_state", self._get)
        node.create_service(SetSimulationState, "~/set_simulation_state", self._set)
        node.create_service(StepSimulation, "~/step_simulation", self._step)
        node.create_service(ResetSimulation, "~/reset_simulation", self._reset)

    def _features(self, request: Any, response: Any) -> Any:
        kinds = SimulatorFeatures
        response.features.features = [
            kinds.SIMULATION_RESET,
            kinds.SIMULATION_STATE_GETTING,
            kinds.SIMULATION_STATE_SETTING,
            kinds.SIMULATION_STATE_PAUSE,
            kinds.STEP_SIMULATION_SINGLE,
            kinds.STEP_SIMULATION_MULTIPLE,
        ]
        response.features.custom_info = "planetary_twin: a step is one published interval"
        return response

    def _get(self, request: Any, response: Any) -> Any:
        response.result.result = Result.RESULT_OK
        response.state.state = self._state()
        return response

    def _set(self, request: Any, response: Any) -> Any:
        wanted = request.state.state
        kinds = SimulationState
        if wanted not in (kinds.STATE_STOPPED, kinds.STATE_PLAYING, kinds.STATE_PAUSED):
            reason = f"state = {wanted}: stopped (0), playing (1) and paused (2) can be set"
            return _refused(response, Result.RESULT_FEATURE_UNSUPPORTED, reason)
        if wanted == self._state():
            code = SetSimulationState.Response.ALREADY_IN_TARGET_STATE
            return _refused(response, code, "the simulation is already in this state")
        return self._carried_out(response, lambda live: self._move(live, wanted))

    def _step(self, request: Any, response: Any) -> Any:
        duration = request.steps * self._node.interval
        return self._carried_out(response, lambda live: executed(live.step(duration)))

    def _reset(self, request: Any, response: Any) -> Any:
        if request.scope not in (
            ResetSimulation.Request.SCOPE_DEFAULT,
            ResetSimulation.Request.SCOPE_ALL,
        ):
            reason = f"scope = {request.scope}: must be 0 or 255; only all can be reset"
            return _refused(response, Result.RESULT_FEATURE_UNSUPPORTED, reason)
        return self._carried_out(response, lambda live: executed(self._node.reset()))

    def _move(self, live: LiveTwin, wanted: int) -> None:
        """Change the state of the time of `live` to `wanted`."""
        if wanted != SimulationState.STATE_PLAYING:
            executed(live.pause(True))
        if wanted == SimulationState.STATE_STOPPED:
            executed(self._node.reset())
        if wanted == SimulationState.STATE_PLAYING:
            executed(live.pause(False))

    def _state(self) -> int:
        """Return the state in terms of the package: a node that is not active has no world."""
        try:
            progress = self._node.running().progress
        except ValueError:
            return int(SimulationState.STATE_NO_WORLD)
        if progress.state in (State.RUNNING, State.WAITING):
            return int(SimulationState.STATE_PLAYING)
        if progress.state == State.PAUSED and progress.simulated == 0.0:
            return int(SimulationState.STATE_STOPPED)
        return int(SimulationState.STATE_PAUSED)

    def _carried_out(self, response: Any, command: Callable[[LiveTwin], object]) -> Any:
        try:
            live = self._node.running()
        except ValueError as refusal:
            return _refused(response, Result.RESULT_INCORRECT_STATE, str(refusal))
        try:
            command(live)
        except (ValueError, TimeoutError) as refusal:
            return _refused(response, Result.RESULT_OPERATION_FAILED, str(refusal))
        response.result.result = Result.RESULT_OK
        return response


def _refused(response: Any, code: int, reason: str) -> Any:
    response.result.result, response.result.error_message = code, reason
    return response
