"""Services that pause a replay, step it and seek in it."""

from __future__ import annotations

from collections.abc import Callable

from planetary_twin_msgs.srv import Seek, Step
from rclpy.node import Node

from ..base.clock import set_stamp
from ..base.services import answer, executed, serve_pause
from .player import Player


def serve_playing(
    node: Node, playing: Callable[[], Player], stamp: Callable[[float], int]
) -> None:
    """
    Create the services `~/pause`, `~/step` and `~/seek` of `node`.

    `playing` returns the player, and raises `ValueError` if there is none. `stamp` returns the
    recorder's time [ns] of a recorded instant [s].
    """

    def step(request: Step.Request, response: Step.Response) -> Step.Response:
        def stepped() -> str:
            if request.command.name or request.commands:
                raise ValueError("command, commands: must be empty: a replay accepts no commands")
            response.simulated_time = executed(playing().step(request.duration))
            set_stamp(response.stamp, stamp(response.simulated_time))
            return ""

        return answer(response, stepped)

    def seek(request: Seek.Request, response: Seek.Response) -> Seek.Response:
        def moved() -> str:
            response.time = executed(playing().seek(request.time))
            set_stamp(response.stamp, stamp(response.time))
            return ""

        return answer(response, moved)

    serve_pause(node, lambda paused: playing().pause(paused))
    node.create_service(Step, "~/step", step)
    node.create_service(Seek, "~/seek", seek)
