"""Services that pause, step and reset simulated time."""

from __future__ import annotations

import contextlib

from planetary_twin_msgs.srv import Step
from sensor_msgs.msg import JointState

from planetary_twin_py import Twin
from planetary_twin_py.recording.ros2.given import joint_names

from ..base.clock import set_stamp
from ..base.services import answer, executed, serve_pause, serve_triggers
from .running import RunningSimulation


def show_ports(twin: Twin, message: JointState) -> None:
    """Fill `message` with angles, speeds and torques of the input and the output shaft."""
    ports = twin.port_states
    message.name = list(joint_names(twin.scene))
    message.position = [ports.input_angle, ports.output_angle]
    message.velocity = [ports.input_speed, ports.output_speed]
    message.effort = [ports.input_torque, ports.output_torque]


class TimeServices:
    """The services `~/pause`, `~/step` and `~/reset` of `node`."""

    def __init__(self, node: RunningSimulation) -> None:
        self._node = node
        serve_pause(node, lambda paused: node.running().pause(paused))
        node.create_service(Step, "~/step", self._step)
        serve_triggers(node, {"reset": self._reset})

    def _step(self, request: Step.Request, response: Step.Response) -> Step.Response:
        states: list[JointState] = []

        def show(twin: Twin) -> None:
            states.append(self._state(twin))
            response.state = states[-1]
            self._date(response, twin.time)

        def step() -> str:
            if request.commands and request.command.name:
                raise ValueError("command: must be empty if there are commands")
            each = [self._node.command(every) for every in request.commands or [request.command]]
            executed(self._node.running().step(request.duration, each, show))
            return ""

        answer(response, step)
        if not states:
            self._date_refusal(response)
        if request.commands:
            response.states = states
        return response

    def _date(self, response: Step.Response, instant: float) -> None:
        """Set the time of a response to a simulated instant [s]."""
        response.simulated_time = instant
        set_stamp(response.stamp, self._node.stamp(instant))

    def _date_refusal(self, response: Step.Response) -> None:
        """Set the time of a response to the present one, which exists if the node is active."""
        with contextlib.suppress(ValueError):
            self._date(response, self._node.running().progress.simulated)

    def _state(self, twin: Twin) -> JointState:
        """Return the present state of the shafts."""
        message = JointState()
        set_stamp(message.header.stamp, self._node.stamp(twin.time))
        if not twin.scene.quasi_static:
            show_ports(twin, message)
        return message

    def _reset(self) -> str:
        return f"starts again at {executed(self._node.reset()):.9g} s"
