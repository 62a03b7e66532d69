"""Services that pause, step and reset simulated time."""

from __future__ import annotations

from concurrent.futures import Future
from typing import Protocol

from planetary_twin_msgs.srv import Step
from rclpy.node import Node
from std_srvs.srv import SetBool, Trigger

from .command_queue import answer
from .live import LiveTwin


class TimeControl(Protocol):
    """The part of a simulation that its services use."""

    def running(self) -> LiveTwin:
        """Return the live twin; raises `ValueError` if there is none."""

    def reset(self) -> Future[float]:
        """Start again at simulated time zero; the future returns the instant [s]."""

    def stamp(self, instant: float) -> int:
        """Return the ROS time [ns] of a simulated instant [s]."""


class TimeServices:
    """The services `~/pause`, `~/step` and `~/reset` of `node` for `control`."""

    def __init__(self, node: Node, control: TimeControl) -> None:
        self._control = control
        node.create_service(SetBool, "~/pause", self._pause)
        node.create_service(Step, "~/step", self._step)
        node.create_service(Trigger, "~/reset", self._reset)

    def _pause(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        word = "paused" if request.data else "runs"
        return answer(
            response,
            lambda: self._control.running().pause(request.data),
            lambda instant: f"{word} from {instant:.9g} s",
        )

    def _step(self, request: Step.Request, response: Step.Response) -> Step.Response:
        def describe(instant: float) -> str:
            response.simulated_time = instant
            stamp = divmod(self._control.stamp(instant), 1_000_000_000)
            response.stamp.sec, response.stamp.nanosec = stamp
            return ""

        return answer(response, lambda: self._control.running().step(request.duration), describe)

    def _reset(self, request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        return answer(
            response, self._control.reset, lambda instant: f"starts again at {instant:.9g} s"
        )
