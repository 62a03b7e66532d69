"""A run of a plant, a follower and a simulation, from their start to a finished recording."""

from __future__ import annotations

import contextlib
import math
from dataclasses import dataclass
from pathlib import Path

from planetary_twin_msgs.msg import FollowerEstimate
from rich.console import Console

from ..clients.loopback import stay_on_this_machine
from .followed import Followed, event_line
from .follower_listener import FollowerListener
from .lock import alone
from .node_process import Child, RunError
from .session import undisturbed

_POLL = 0.2  # [s]


@dataclass(frozen=True)
class PlantPlan:
    """Settings of a run; paths are absolute, or empty."""

    scene: str
    duration: float  # [s]
    folder: Path
    hidden: str = ""
    sensors: str = ""
    namespace: str = "/planetary_twin"


def run_plant_session(plan: PlantPlan, console: Console) -> Followed:
    """
    Run `plan` to its end, or until interrupted; in both cases, the recording is finished.

    Changes are shown on `console` when they are found. Raises `RunError` if a node fails.
    """
    stay_on_this_machine()
    with alone(plan.namespace):
        return _run(plan, console)


def _run(plan: PlantPlan, console: Console) -> Followed:
    nodes: list[Child] = []

    def watch() -> None:
        for node in nodes:
            node.check()

    with contextlib.ExitStack() as stack:
        for name, given in _parameters(plan).items():
            nodes.append(stack.enter_context(Child(name, plan.namespace, given)))
        listener = stack.enter_context(FollowerListener(plan.namespace, watch))
        plant = nodes.pop()  # ends by itself, and with it the run
        with contextlib.suppress(KeyboardInterrupt):
            _watch(listener, plant, console)
        with undisturbed():
            if plant.stop() != 0:
                raise RunError(plant.last_line() or "plant: ended with an error")
            listener.finish()
            for node in reversed(nodes):
                if node.stop() != 0:
                    raise RunError(node.last_line() or f"{node.node}: ended with an error")
        if listener.estimate is None or listener.begin is None:
            raise RunError("follower: has published no estimate")
        events = [listener.events[number] for number in sorted(listener.events)]
        return Followed(
            plan.folder,
            listener.begin,
            listener.estimate,
            listener.teeth,
            events,
            listener.condition,
        )


def _parameters(plan: PlantPlan) -> dict[str, dict[str, object]]:
    """Return the parameters of the nodes, in the order of their start."""
    given = {"scene": plan.scene}
    logger = {"directory": plan.folder.parent.absolute(), "name": plan.folder.name}
    sensors = {"sensors": plan.sensors} if plan.sensors else {}
    plant = {"duration": float(plan.duration), "wait_for": "[follower, logger]"}
    return {
        "logger": given | logger,
        "simulation": given | {"wait_for": "logger"},
        "follower": given | {"twin": "simulation"} | sensors,
        "plant": given | plant | ({"hidden": plan.hidden} if plan.hidden else {}),
    }


def _watch(listener: FollowerListener, plant: Child, console: Console) -> None:
    """Show the newest estimate and each new change until the plant ends."""
    shown = 0
    with console.status("starting") as status:
        while plant.returncode is None:
            listener.wait(lambda: False, _POLL)
            if listener.begin is None or listener.estimate is None:
                continue
            estimate = listener.estimate
            passed = estimate.header.stamp.sec + 1e-9 * estimate.header.stamp.nanosec
            status.update(_line(passed - listener.begin, estimate))
            for number in sorted(listener.events)[shown:]:
                line = event_line(listener.events[number], listener.begin)
                console.print(line, highlight=False, markup=False, soft_wrap=True)
                shown += 1


def _line(seconds: float, estimate: FollowerEstimate) -> str:
    level = estimate.friction_level
    friction = "-" if math.isnan(level) else f"{level:.3f}"
    return (
        f"{max(seconds, 0.0):6.1f} s  {estimate.input_torque:6.2f} N m  "
        f"loss {estimate.loss_torque:6.3f} N m  friction level {friction}"
    )
