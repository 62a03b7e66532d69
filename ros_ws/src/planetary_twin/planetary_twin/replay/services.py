"""Services that pause a replay, step it and seek in it."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future

from builtin_interfaces.msg import Time
from planetary_twin_msgs.srv import Seek, Step
from rclpy.node import Node
from std_srvs.srv import SetBool

from ..base.clock import set_stamp
from ..base.command_queue import answer
from .player import Player


class PlayingServices:
    """
    The services `~/pause`, `~/step` and `~/seek` of `node`.

    `playing` returns the player, and raises `ValueError` if there is none. `stamp` returns the
    recorder's time [ns] of a recorded instant [s].
    """

    def __init__(
        self, node: Node, playing: Callable[[], Player], stamp: Callable[[float], int]
    ) -> None:
        self._playing, self._stamp = playing, stamp
        node.create_service(SetBool, "~/pause", self._pause)
        node.create_service(Step, "~/step", self._step)
        node.create_service(Seek, "~/seek", self._seek)

    def _pause(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        word = "paused" if request.data else "runs"
        return answer(
            response,
            lambda: self._playing().pause(request.data),
            lambda instant: f"{word} from {instant:.9g} s",
        )

    def _step(self, request: Step.Request, response: Step.Response) -> Step.Response:
        def describe(instant: float) -> str:
            response.simulated_time = instant
            return self._set(response.stamp, instant)

        def step() -> Future[float]:
            if request.command.name or request.commands:
                raise ValueError("command, commands: must be empty: a replay accepts no commands")
            return self._playing().step(request.duration)

        return answer(response, step, describe)

    def _seek(self, request: Seek.Request, response: Seek.Response) -> Seek.Response:
        def describe(instant: float) -> str:
            response.time = instant
            return self._set(response.stamp, instant)

        return answer(response, lambda: self._playing().seek(request.time), describe)

    def _set(self, stamp: Time, instant: float) -> str:
        set_stamp(stamp, self._stamp(instant))
        return ""
