"""Services that execute a command: their response says what was done, or why it was refused."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from concurrent.futures import Future
from functools import partial
from typing import Any

from rclpy.node import Node
from std_srvs.srv import SetBool, Trigger

_TIMEOUT = 60.0  # [s] longest wait for the execution of a command


def answer(response: Any, command: Callable[[], str]) -> Any:
    """
    Execute `command`, whose text becomes the message of `response`, which is returned.

    If it raises `ValueError` or `OSError`, such as `TimeoutError`, the response refuses with the
    reason.
    """
    try:
        response.message = command()
        response.success = True
    except (ValueError, OSError) as refusal:
        response.success, response.message = False, str(refusal)
    return response


def executed(command: Future[float], timeout: float = _TIMEOUT) -> float:
    """Wait until `command` is executed, and return its instant [s]."""
    try:
        return command.result(timeout)
    except TimeoutError:
        raise TimeoutError(f"not executed within {timeout:g} s; it may follow") from None


def serve_triggers(node: Node, commands: Mapping[str, Callable[[], str]]) -> None:
    """Create a service `~/NAME` of `node` for each of `commands` by name, see `answer`."""

    def serve(command: Callable[[], str], request: Any, response: Any) -> Any:
        return answer(response, command)

    for name, command in commands.items():
        node.create_service(Trigger, f"~/{name}", partial(serve, command))


def serve_pause(node: Node, pause: Callable[[bool], Future[float]]) -> None:
    """Create the service `~/pause` of `node`; `pause` pauses time, or resumes it."""

    def serve(request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        word = "paused" if request.data else "runs"
        return answer(response, lambda: f"{word} from {executed(pause(request.data)):.9g} s")

    node.create_service(SetBool, "~/pause", serve)
