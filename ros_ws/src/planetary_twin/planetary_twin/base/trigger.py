"""Services of type Trigger that execute a command."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from rclpy.node import Node
from std_srvs.srv import Trigger


def serve_triggers(node: Node, commands: Mapping[str, Callable[[], str]]) -> None:
    """
    Create a service `~/NAME` of `node` for each of `commands` by name.

    A command returns the message of the response. If it raises `ValueError` or `OSError`, such as
    `TimeoutError`, the response refuses with the reason.
    """
    for name, command in commands.items():
        node.create_service(Trigger, f"~/{name}", _answering(command))


def _answering(
    command: Callable[[], str],
) -> Callable[[Trigger.Request, Trigger.Response], Trigger.Response]:
    def answer(request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        try:
            response.message = command()
            response.success = True
        except (ValueError, OSError) as refusal:
            response.success, response.message = False, str(refusal)
        return response

    return answer
