"""The follower node: estimates the state of a gearbox from measured topics."""

from __future__ import annotations

import time
from collections.abc import Mapping
from copy import deepcopy
from pathlib import Path
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray
from planetary_twin_msgs import msg
from rclpy.duration import Duration
from rclpy.lifecycle import LifecyclePublisher
from rclpy.qos import QoSProfile

import planetary_twin_py as pt
from planetary_twin_py.durability.damage_state import HOUR, DamageState
from planetary_twin_py.durability.run_damage import state_fields, teeth_fields
from planetary_twin_py.following.damage.followed import FollowedDamage
from planetary_twin_py.following.estimate import Event
from planetary_twin_py.following.state import Following
from planetary_twin_py.following.train import followed_train

from ..base.clock import StrictClock, set_stamp
from ..base.damage import NEWEST, damage_row, fill, serve_damage
from ..base.diagnostics import diagnostics
from ..base.lifecycle_node import ManagedNode
from ..base.parameters import settings_of
from ..base.qos import LATCHED
from ..base.spin import run_node
from ..process.memory import return_large_blocks
from .diagnostics import Feed, Limits, key_of, rows
from .live_follower import LiveFollower
from .messages import (
    baseline_message,
    estimate_message,
    event_message,
    residuals_message,
    teeth_message,
    time_of,
)
from .parameters import FollowerSettings, declare_parameters, followed
from .services import serve_follower
from .simulation_client import TwinBeside
from .subscriptions import Intake

_REPORT_PERIOD = 1.0  # [s]
_QUEUED = QoSProfile(depth=1000)  # an overloaded computer publishes many messages at once
_LAST = 10.0  # [s] longest wait until the last messages have arrived
_KINDS = {
    "estimate": msg.FollowerEstimate,
    "residuals": msg.FollowerResiduals,
    "teeth": msg.FollowerTeeth,
    "event": msg.FollowerEvent,
    "baseline": msg.FollowerBaseline,
}
_DAMAGE = {"damage_state": msg.DamageState, "damage_teeth": msg.DamageTeeth}
_KEPT = {"event", "baseline"}  # for late subscribers
_TEETH_EVERY = 10  # messages of damage_state for one of damage_teeth


class Follower(ManagedNode):
    """
    Estimates the state of a measured gearbox.

    `activate` starts without readings; `deactivate` processes waiting messages and publishes the
    last estimate. A thread receives, processes and publishes, so that services respond while
    tables are computed.
    """

    def __init__(self) -> None:
        super().__init__("follower")
        return_large_blocks()
        declare_parameters(self)
        self._settings = settings_of(self, FollowerSettings)
        self._followed = followed(self)
        self._intake: Intake | None = None
        self._beside: TwinBeside | None = None
        self._live: LiveFollower | None = None
        self._outlets: dict[str, LifecyclePublisher] = {}
        self._sequence: dict[str, int] = {}
        self._events: dict[tuple[str, float], tuple[int, Event]] = {}
        self._periods, self._learned, self._jumps = 0, "", 0
        self._teeth: list[int] = []
        self._now = StrictClock(self.get_clock())
        self._acknowledged: set[tuple[str, float]] = set()
        self._damage: DamageState | None = None  # as last reported
        self._damage_fault = ""  # why its file was not written
        serve_follower(self, self._active, self._acknowledge)
        serve_damage(self, self._save_damage, self._replace_part)

    def configure(self) -> None:
        """Load the scene and the sensors, and create publishers and subscriptions."""
        self._settings, self._followed = settings_of(self, FollowerSettings), followed(self)
        self._followed.follower()  # refuses a scene that cannot be followed
        train = followed_train(self._followed.scene)
        self._teeth = list(train.teeth.values())
        if self._settings.twin:
            self._beside = self.opened(TwinBeside(self, self._settings.twin, train))
        self._outlets = {
            name: self.outlet(kind, f"~/{name}", LATCHED if name in _KEPT else _QUEUED)
            for name, kind in _KINDS.items()
        }
        if self._followed.damage_file is not None:
            qos = {"damage_state": NEWEST, "damage_teeth": _QUEUED}
            for name, kind in _DAMAGE.items():
                self._outlets[name] = self.outlet(kind, f"~/{name}", qos[name])
        self._outlets["diagnostics"] = self.outlet(DiagnosticArray, "/diagnostics")
        self._sequence = dict.fromkeys((*_KINDS, *_DAMAGE), 0)
        self._intake = self.opened(Intake(self))
        for kind in self._intake.missing:
            self.get_logger().info(f"{kind} is not installed: there is no subscription")

    def activate(self) -> None:
        """Start to follow, without readings."""
        if self._intake is None:
            raise ValueError("the node is not configured")
        self._live = LiveFollower(self._followed, self._settings, self._intake, self)
        self.every(_REPORT_PERIOD, self._diagnose)
        self.get_logger().info(f"following {self._followed.scene.name}")

    def deactivate(self) -> None:
        """Process the waiting messages, and publish the last estimate."""
        self._active().stop()
        self._diagnose()
        self._live = None
        self._deliver()

    def close(self) -> None:
        """End following."""
        if self._live is not None:
            self._live.stop()
        self._live = self._intake = self._beside = None

    # Called by the live follower, in its thread.

    def started(self) -> None:
        """Count events and hunting periods from one again."""
        self._events, self._periods, self._learned = {}, 0, ""
        self._acknowledged = set()

    def estimated(self, following: Following) -> None:
        """Publish a new estimate."""
        frame = self._settings.frame_id
        self._send("estimate", estimate_message(following, frame, self._next("estimate")))
        self._send("residuals", residuals_message(following, frame, self._next("residuals")))
        self._announce(following)
        if self._beside is not None:
            self._beside.follow(following)
        periods = following.counters.get("hunting_periods", 0)
        if periods != self._periods:
            self._periods = periods
            number = self._next("teeth")
            self._send("teeth", teeth_message(following, frame, number, self._teeth))
        learned = repr([cell[2:] for cell in following.cells])
        if learned != self._learned and following.cells:
            self._learned = learned
            self._send("baseline", baseline_message(following, frame, self._next("baseline")))

    def counted(self, damage: FollowedDamage, *, save: bool) -> None:
        """Publish the damage of the readings so far, and write it if `save`."""
        state = damage.state
        self._damage = deepcopy(state)
        self._send_damage("damage_state", state, state_fields(state, HOUR * damage.rates))
        if (self._sequence["damage_state"] - 1) % _TEETH_EVERY == 0:
            self._send_damage("damage_teeth", state, teeth_fields(state, damage.teeth))
        if save:
            self._write(damage)

    def _send_damage(self, name: str, state: DamageState, fields: Mapping[str, Any]) -> None:
        message = fill(_DAMAGE[name](sequence=self._next(name)), fields)
        message.header.stamp = time_of(state.last.time)
        message.header.frame_id = self._settings.frame_id
        self._send(name, message)

    def _write(self, damage: FollowedDamage) -> None:
        """Write the file; a failure is reported, and following goes on."""
        try:
            damage.save()
        except (ValueError, OSError) as reason:
            self._damage_fault = f"the damage is not saved: {reason}"
            self.get_logger().error(self._damage_fault)
        else:
            self._damage_fault = ""

    def _save_damage(self) -> Path:
        self._active().ask(pt.Follower.save_damage)
        self._damage_fault = ""
        return self._followed.damage_file or Path()

    def _replace_part(self, name: str) -> tuple[str, ...]:
        """Set the damage of a part to 0, and write the file at once."""
        parts: list[str] = []

        def replace(follower: pt.Follower) -> None:
            parts.extend(follower.replace_part(name))
            follower.save_damage()

        self._active().ask(replace)
        return tuple(parts)

    def refused(self, reason: str) -> None:
        """Report readings that contradict the scene."""
        self.get_logger().error(f"{reason}; following has ended until ~/reset")

    def jumped(self, seconds: float) -> None:
        """Report stamps that have jumped back."""
        self._jumps += 1
        restarts = self._settings.reset_on_time_jump
        what = "restarts" if restarts else "readings are late until stamps are newer than before"
        self.get_logger().warning(f"stamps have jumped back by {seconds:.1f} s: {what}")

    def stopped(self, defect: Exception) -> None:
        """Report the exception that ended the thread."""
        self.broke("following", defect)

    def _active(self) -> LiveFollower:
        """Return the live follower; raises `ValueError` if there is none."""
        if self._live is None:
            raise ValueError("the follower is not active")
        return self._live

    def _acknowledge(self) -> int:
        """Acknowledge all events; return how many are new to it."""
        before = len(self._acknowledged)
        self._acknowledged.update(key_of(event) for event in self._active().latest.events)
        return len(self._acknowledged) - before

    def _announce(self, following: Following) -> None:
        """Publish events that are new or have changed."""
        for event in following.events:
            key = key_of(event)
            number, before = self._events.get(key, (len(self._events) + 1, None))
            if event == before:
                continue
            if before is None:
                self.get_logger().warning(f"{event.what}: {event.evidence}")
            self._events[key] = number, event
            sequence = self._next("event")
            self._send("event", event_message(event, self._settings.frame_id, sequence, number))

    def _next(self, name: str) -> int:
        self._sequence[name] += 1
        return self._sequence[name]

    def _send(self, name: str, message: object) -> None:
        self._outlets[name].publish(message)

    def _deliver(self) -> None:
        """Wait until subscribers have received all: a logger may end at once after this node."""
        deadline = time.monotonic() + _LAST
        for publisher in self._outlets.values():
            left = max(deadline - time.monotonic(), 0.0)
            publisher.wait_for_all_acked(Duration(seconds=left))

    def _diagnose(self) -> None:
        live, intake = self._live, self._intake
        if live is None or intake is None:
            return
        timeout = self._settings.sensor_timeout
        feed = Feed(
            live.silent, timeout, live.refusal, self._jumps, live.behind, intake.shared,
            frozenset(self._acknowledged),
        )  # fmt: skip
        limits = Limits(*(self.get_parameter(f"{n}_limit").value for n in ("friction", "tooth")))
        namespace = self.get_namespace()
        hardware = self._settings.hardware_id or namespace
        reports = rows(live.latest, feed, limits)
        if self._damage is not None:
            reports.append(damage_row("follower: damage", self._damage, self._damage_fault))
        message = diagnostics(reports, namespace, hardware)
        set_stamp(message.header.stamp, self._now.now())
        self._send("diagnostics", message)


def main(args: list[str] | None = None) -> int:
    """Run the node until a signal ends it; returns the exit code."""
    return run_node(Follower, args)
