"""Commands for the shafts of motor and load, from the topic ~/command."""

from __future__ import annotations

import math
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterable
from typing import Protocol

from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import JointState

from planetary_twin_py import Scene, Twin
from planetary_twin_py.recording.ros2.given import SIDES, joint_names, values_of
from planetary_twin_py.recording.ros2.topics import status_name
from planetary_twin_py.scene.drive import Causality, Ports

COMMANDS = "simulation: commands"
SILENCE = ("hold", "zero", "brake")
"""Reaction to missing commands: hold the last one, remove it, or brake the input shaft."""
_QUANTITIES = {"machine": (), "torque": ("torque",), "motion": ("speed", "position")}  # by port
_TURN = 2.0 * math.pi
_OUT_OF_RANGE = "out of range"
_AHEAD = 1_000_000_000  # [ns] by which stamps may be ahead: clocks of two computers differ
QOS = QoSProfile(depth=200, reliability=ReliabilityPolicy.BEST_EFFORT)
"""QoS of ~/command: it matches reliable and best-effort publishers, and holds what several fast
clients send within an interval."""


class Given(Protocol):
    """Parameters of the commands."""

    scene: Scene
    command_timeout: float
    command_silence: str
    continuous_joints: bool


def for_ports(values: dict[str, float], twin: Twin) -> dict[str, float]:
    """Return those `values` that are given at the ports of `twin`."""
    sides = zip(SIDES, twin.ports, strict=True)
    names = [f"{side}_{quantity}" for side, port in sides for quantity in _QUANTITIES[port]]
    return {name: values[name] for name in names if name in values}


def nearest_turn(values: dict[str, float], twin: Twin) -> dict[str, float]:
    """Return `values`, with whole turns added to positions: nearest to the shafts of `twin`."""
    near = dict(values)
    for side in SIDES:
        name = f"{side}_position"
        if name in near:
            angle = getattr(twin.port_states, f"{side}_angle")
            near[name] += _TURN * round((angle - near[name]) / _TURN)
    return near


class ShaftCommands:
    """
    Takes commands in the thread of the twin and passes on the newest one of each joint.

    Joints are independent of one another, so each can have its own client. A stamped command has
    no effect if it is not newer than the last one of its joint, older than the timeout, or more
    than a second ahead. A command without a stamp acts in the order of arrival. `now` returns the
    ROS time of the stamps [ns]. `take` returns the messages that have arrived since its last call,
    with their times of arrival by the system clock [ns].
    """

    def __init__(
        self,
        given: Given,
        now: Callable[[], int],
        take: Callable[[], Iterable[tuple[int, JointState]]],
    ) -> None:
        self.joints = joint_names(given.scene)
        self.ignored = Counter[str]()
        """Messages without effect, by reason."""
        self._timeout, self._silence = given.command_timeout, given.command_silence
        self._continuous = given.continuous_joints
        self._now, self._take = now, take
        self._lock = threading.Lock()
        self._values: dict[str, dict[str, float]] = {}  # by side
        self._newest = dict.fromkeys(SIDES, 0)  # [ns] stamps of the last commands
        self._received: dict[str, float] = {}  # [s] steady clock, of the last commands
        self._brake = _Brake()

    def collect(self) -> None:
        """Take the commands that have arrived."""
        for arrival, message in self._take():
            self.receive(message, time.time_ns() - arrival)

    def receive(self, message: JointState, waited: int = 0) -> None:
        """
        Take a command, unless it is late, ahead, repeated or out of order.

        `waited` is the time since its arrival [ns].
        """
        stamp = message.header.stamp.sec * 1_000_000_000 + message.header.stamp.nanosec
        values, now = values_of(message, self.joints), self._now() - waited if stamp else 0
        reasons = set[str]()
        if _has_surplus(message):
            values = {}
            reasons.add("more values than names")
        elif not values:
            reasons.add(f"no effort, velocity or position of {' or '.join(self.joints)}")
        with self._lock:
            for side in SIDES:
                own = {name: value for name, value in values.items() if name.startswith(side)}
                reason = self._fault(side, stamp, now) if own else ""
                if reason:
                    reasons.add(reason)
                elif own:
                    self._newest[side] = stamp or self._newest[side]
                    self._values[side] = own
                    self._received[side] = time.monotonic()
            self.ignored.update(reasons)

    def _fault(self, side: str, stamp: int, now: int) -> str:
        if not stamp:
            return ""
        if stamp > now + _AHEAD:
            return "ahead of the clock"
        if self._timeout and now - stamp > 1e9 * self._timeout:
            return "late"
        # A newest stamp ahead of the clock shows that the clock was set back: ignore it.
        if stamp <= self._newest[side] <= now + _AHEAD:
            return "repeated or out of order"
        return ""

    def _silent(self) -> dict[str, float]:
        """Return the sides without a command for longer than the timeout, and for how long [s]."""
        now = time.monotonic()
        silent = {side: now - received for side, received in self._received.items()}
        return {side: t for side, t in silent.items() if self._timeout and t > self._timeout}

    def status(self, hardware: str) -> DiagnosticStatus:
        """Return the report on commands for `/diagnostics`; `hardware` is the namespace."""
        with self._lock:
            silent, ignored = self._silent(), dict(self.ignored)
            message = "received" if self._received else "no command yet"
        if silent:
            names = dict(zip(SIDES, self.joints, strict=True))
            longest = max(silent.values())
            joints = " and ".join(names[side] for side in silent)
            message = f"no command for {joints} for {longest:.1f} s: {self._silence}"
        return DiagnosticStatus(
            level=DiagnosticStatus.WARN if silent or ignored else DiagnosticStatus.OK,
            name=status_name(COMMANDS, hardware),
            message=message,
            hardware_id=hardware,
            values=[KeyValue(key=f"ignored: {why}", value=str(n)) for why, n in ignored.items()],
        )

    def given(self, twin: Twin, interval: float) -> dict[str, float]:
        """
        Return the commands from the present time of `twin` on, as arguments of `Twin.advance`.

        `interval` [s] is that of a running twin. It is 0 for a step of a paused twin, in which
        commands cannot be missing.
        """
        self.collect()
        with self._lock:
            received, self._values = self._values, {}
            self._watch(self._brake.ports(twin))
            silent = self._silent() if interval else {}
        if silent and self._silence == "brake":
            return self._brake.slow(twin, interval)
        if received:
            self._brake.release(twin)
        values = {name: value for own in received.values() for name, value in own.items()}
        given = self._taken(values, twin)
        if silent and self._silence == "zero":
            names = (f"{side}_{quantity}" for side in silent for quantity in ("torque", "speed"))
            given |= for_ports(dict.fromkeys(names, 0.0), twin)
        return given

    def refuse(self) -> None:
        """Count the commands that `given` has returned last: the twin has refused them."""
        with self._lock:
            self.ignored[_OUT_OF_RANGE] += 1

    def release(self, twin: Twin) -> None:
        """End a brake: restore the ports of `twin`."""
        self._brake.release(twin)

    def _watch(self, ports: Ports) -> None:
        """Ignore machines in the timeout; a new port is monitored from its first command on."""
        for side, port in zip(SIDES, ports, strict=True):
            if port == "machine":
                self._received.pop(side, None)

    def _taken(self, values: dict[str, float], twin: Twin) -> dict[str, float]:
        """Return those `values` that the ports accept; count joints without an accepted value."""
        taken = for_ports(values, twin)
        for side, joint, port in zip(SIDES, self.joints, twin.ports, strict=True):
            given, used = (any(name.startswith(side) for name in each) for each in (values, taken))
            if given and not used:
                with self._lock:
                    self.ignored[f"{joint}: drive.{side}.port = {port}"] += 1
        return taken if self._continuous else nearest_turn(taken, twin)


def _has_surplus(message: JointState) -> bool:
    """Return whether `message` has values without a name; ros2_control sends fewer, never more."""
    longest = max(len(message.position), len(message.velocity), len(message.effort))
    return longest > len(message.name)


class _Brake:
    """Brings the input shaft to rest at the slew rate of the drive, and holds it."""

    def __init__(self) -> None:
        self._before: tuple[Twin, Ports] | None = None  # braked twin, its ports without the brake

    def ports(self, twin: Twin) -> Ports:
        """Return the ports of `twin` without the brake."""
        braked, ports = self._before or (None, None)
        return ports if ports is not None and braked is twin else twin.ports

    def slow(self, twin: Twin, interval: float) -> dict[str, float]:
        """Return the speed that the input shaft has in the next `interval` [s]."""
        before = self.ports(twin)
        twin.set_ports("motion", _braked(before.output))
        self._before = twin, before
        speed = twin.port_states.input_speed
        less = twin.scene.drive.speed_control.slew_rate * interval
        slower = math.copysign(max(abs(speed) - less, 0.0), speed)
        return for_ports({"input_speed": slower, "output_torque": 0.0}, twin)

    def release(self, twin: Twin) -> None:
        """Restore the ports from before the brake."""
        twin.set_ports(*self.ports(twin))
        self._before = None


def _braked(port: Causality) -> Causality:
    """Return the port of the output while the input is braked: a torque, which is zero."""
    return "torque" if port == "motion" else port
