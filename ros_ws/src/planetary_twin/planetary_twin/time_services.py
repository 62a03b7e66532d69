"""Services that stop simulated time, make it go step by step, and begin it anew."""

from __future__ import annotations

from concurrent.futures import Future
from typing import Protocol

from planetary_twin_msgs.srv import Step
from rclpy.node import Node
from std_srvs.srv import SetBool, Trigger

from .live import LiveTwin
from .orders import answer


class Clockwork(Protocol):
    """The simulation, as far as its time is concerned."""

    def running(self) -> LiveTwin:
        """Return the live twin; raises `ValueError` where there is none."""

    def reset(self) -> Future[float]:
        """Begin anew at simulated time zero."""

    def stamp(self, instant: float) -> int:
        """ROS time [ns] of a simulated instant [s]."""


class TimeServices:
    """`~/pause`, `~/step` and `~/reset` of a node."""

    def __init__(self, node: Node, clockwork: Clockwork) -> None:
        self._clockwork = clockwork
        node.create_service(SetBool, "~/pause", self._pause)
        node.create_service(Step, "~/step", self._step)
        node.create_service(Trigger, "~/reset", self._reset)

    def _pause(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        word = "paused" if request.data else "runs"
        return answer(
            response,
            lambda: self._clockwork.running().pause(request.data),
            lambda instant: f"{word} from {instant:.9g} s",
        )

    def _step(self, request: Step.Request, response: Step.Response) -> Step.Response:
        def told(instant: float) -> str:
            response.simulated_time = instant
            stamp = divmod(self._clockwork.stamp(instant), 1_000_000_000)
            response.stamp.sec, response.stamp.nanosec = stamp
            return ""

        return answer(response, lambda: self._clockwork.running().step(request.duration), told)

    def _reset(self, request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        return answer(
            response, self._clockwork.reset, lambda instant: f"begins anew at {instant:.9g} s"
        )
