"""Changes the twin that make_sample records, at instants of its own time; ends when it has run."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from lifecycle_msgs.srv import ChangeState
from planetary_twin.clients.client import Client
from planetary_twin_msgs.msg import GearboxState
from planetary_twin_msgs.srv import SetOperatingPoint

from planetary_twin_py import rpm

CHANGES = {  # [s] simulated: what holds from the first interval after it, in SI
    0.3: {"lambda_ratio": 2.0},
    0.6: {"backlash": 3.5e-7},
    0.9: {"input_speed": rpm(1500.0), "input_torque": 40.0},
}
END = 1.15  # [s] by then the motor has got there
TIMEOUT = 60.0  # [s]
STARTS = 30.0  # [s] for a transition, which may have to wait for subscribers
TOPIC = "gearbox_state"
SUBSCRIBERS = 2  # this node and the logger


def main() -> None:
    """Start the simulation once this node and the logger subscribe, and change it as it runs.

    So the recording has no gap between its first latched message and the first state.
    """
    newest = [0.0]

    def keep(state: GearboxState) -> None:
        newest[0] = state.simulated_time

    with Client("changes", "/planetary_twin") as client:
        kind, service = SetOperatingPoint, "simulation/set_operating_point"
        wait(client, lambda: client.serves(kind, service))
        client.node.create_subscription(GearboxState, TOPIC, keep, 10)
        transition(client, "configure")
        wait(client, lambda: client.node.count_subscribers(TOPIC) >= SUBSCRIBERS)
        transition(client, "activate")
        for instant, values in CHANGES.items():
            wait(client, partial(reached, newest, instant))
            request = kind.Request(names=list(values), values=list(values.values()))
            answer = client.call(kind, service, request)
            if answer is None or not answer.success:
                raise SystemExit(f"{values}: {answer.message if answer else 'no answer'}")
        wait(client, partial(reached, newest, END))


def transition(client: Client, label: str) -> None:
    """Change the lifecycle state of the simulation."""
    service = "simulation/change_state"
    wait(client, lambda: client.serves(ChangeState, service))
    request = ChangeState.Request()
    request.transition.label = label
    answer = client.call(ChangeState, service, request, STARTS)
    if answer is None or not answer.success:
        raise SystemExit(f"{label}: failed")


def reached(newest: list[float], instant: float) -> bool:
    """Whether the newest state is of `instant` [s] or later."""
    return newest[0] >= instant


def wait(client: Client, ready: Callable[[], bool]) -> None:
    """Wait until `ready`, and give up where that does not come."""
    if not client.wait(ready, TIMEOUT):
        raise SystemExit("the twin did not get there")


main()
