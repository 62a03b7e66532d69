"""Services that start and end recordings while the logger is active."""

from __future__ import annotations

from collections.abc import Callable

from rclpy.node import Node
from std_srvs.srv import Trigger

from .recorder import Recorder, RecorderError


class RecordingServices:
    """
    The services `~/start`, `~/stop`, `~/split` and `~/snapshot` of `node`.

    `active` returns the recorder, and raises `RecorderError` if there is none. The response gives
    the file, or the reason of a refusal.
    """

    def __init__(self, node: Node, active: Callable[[], Recorder]) -> None:
        commands: dict[str, Callable[[Recorder], str]] = {
            "start": Recorder.start,
            "stop": Recorder.stop,
            "split": Recorder.split,
            "snapshot": Recorder.snapshot,
        }
        for name, command in commands.items():
            node.create_service(Trigger, f"~/{name}", _answering(active, command))


def _answering(
    active: Callable[[], Recorder], command: Callable[[Recorder], str]
) -> Callable[[Trigger.Request, Trigger.Response], Trigger.Response]:
    def answer(request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        try:
            response.message = command(active())
            response.success = True
        except RecorderError as refusal:
            response.success, response.message = False, str(refusal)
        return response

    return answer
