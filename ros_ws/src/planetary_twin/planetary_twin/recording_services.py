"""Services that begin and end recordings while the logger is active."""

from __future__ import annotations

from collections.abc import Callable

from rclpy.node import Node
from std_srvs.srv import Trigger

from .recorder import Recorder, Refused


class RecordingServices:
    """
    `~/start`, `~/stop`, `~/split` and `~/snapshot` of a node.

    `active` gives its recorder, and raises `Refused` where it has none. The answer names the file,
    or why there is none.
    """

    def __init__(self, node: Node, active: Callable[[], Recorder]) -> None:
        orders: dict[str, Callable[[Recorder], str]] = {
            "start": Recorder.start,
            "stop": Recorder.stop,
            "split": Recorder.split,
            "snapshot": Recorder.snapshot,
        }
        for name, order in orders.items():
            node.create_service(Trigger, f"~/{name}", _answering(active, order))


def _answering(
    active: Callable[[], Recorder], order: Callable[[Recorder], str]
) -> Callable[[Trigger.Request, Trigger.Response], Trigger.Response]:
    def answer(request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        try:
            response.message = order(active())
            response.success = True
        except Refused as refusal:
            response.success, response.message = False, str(refusal)
        return response

    return answer
