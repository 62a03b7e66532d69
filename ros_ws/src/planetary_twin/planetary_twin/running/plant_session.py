"""A run of a plant, a follower and a simulation, from their start to a finished recording."""

from __future__ import annotations

import contextlib
import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from diagnostic_msgs.msg import DiagnosticArray
from planetary_twin_msgs.msg import FollowerEstimate, FollowerEvent, FollowerTeeth
from rich.console import Console
from sensor_msgs.msg import JointState

from planetary_twin_py.following.channels.stamp import stamp_of
from planetary_twin_py.recording.ros2.topics import status_name

from ..base.qos import LATCHED
from ..clients.loopback import stay_on_this_machine
from ..follower.diagnostics import CONDITION
from .followed import Followed, event_line
from .node_process import Child, RunError, alone
from .run_client import RunClient
from .session import logger_parameters, undisturbed

_POLL = 0.2  # [s]
_SETTLED = 0.5  # [s] without a new estimate after which no further one is expected
_TIMEOUT = 10.0  # [s] until the logger has counted the last estimate


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


class FollowerListener(RunClient):
    """
    Keeps the newest messages of the follower in `namespace`.

    `watch` is called repeatedly while it waits. `events` are changes by their numbers, as last
    published, `begin` is the stamp of the first reading [s], `condition` the last report on the
    condition: what it means that there are no changes.
    """

    def __init__(self, namespace: str, watch: Callable[[], None]) -> None:
        super().__init__("follower_listener", namespace, watch)
        self.estimate: FollowerEstimate | None = None
        self.teeth: FollowerTeeth | None = None
        self.events: dict[int, FollowerEvent] = {}
        self.begin: float | None = None
        self.condition = ""
        self._report = status_name(f"follower: {CONDITION}", namespace)
        self._arrived = time.monotonic()
        subscribe = self.node.create_subscription
        subscribe(FollowerEstimate, "follower/estimate", self._on_estimate, 100)
        subscribe(FollowerEvent, "follower/event", self._on_event, LATCHED)
        subscribe(JointState, "measured/joint_states", self._on_joints, 10)
        self.keep("teeth", FollowerTeeth, "follower/teeth", 100)

    def finish(self) -> None:
        """
        Deactivate the follower, and wait until its last estimate is received and recorded.

        Raises `RunError` if it refuses.
        """
        self.change_state("follower", "deactivate", "active", "inactive", math.inf)
        self.wait(lambda: time.monotonic() > self._arrived + _SETTLED, _TIMEOUT)
        self.wait(self._recorded, _TIMEOUT)

    def _recorded(self) -> bool:
        """Return whether the logger has counted the last estimate."""
        topic = self.node.resolve_topic_name("follower/estimate")
        return self.estimate is None or self.accounted().get(topic, 0) >= self.estimate.sequence

    def _on_estimate(self, message: FollowerEstimate) -> None:
        self.estimate, self._arrived = message, time.monotonic()

    def _on_event(self, message: FollowerEvent) -> None:
        self.events[message.number] = message

    def on_diagnostics(self, message: DiagnosticArray) -> None:
        """Receive reports of a node."""
        for status in message.status:
            if status.name == self._report:
                self.condition = status.message

    def _on_joints(self, message: JointState) -> None:
        stamp = stamp_of(message)
        self.begin = stamp if self.begin is None else min(self.begin, stamp)


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
    given: dict[str, object] = {"scene": plan.scene}
    sensors = {"sensors": plan.sensors} if plan.sensors else {}
    plant = {"duration": float(plan.duration), "wait_for": "[follower, logger]"}
    return {
        "logger": logger_parameters(plan.scene, plan.folder),
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
            passed = stamp_of(estimate) - listener.begin
            status.update(_line(passed, estimate))
            for number in sorted(listener.events)[shown:]:
                line = event_line(listener.events[number], listener.begin)
                console.print(line, highlight=False, markup=False, soft_wrap=True)
                shown += 1


def _line(passed: float, estimate: FollowerEstimate) -> str:
    level = estimate.friction_level
    friction = "-" if math.isnan(level) else f"{level:.3f}"
    return (
        f"{max(passed, 0.0):6.1f} s  {estimate.input_torque:6.2f} N m  "
        f"loss {estimate.loss_torque:6.3f} N m  friction level {friction}"
    )
