"""Commands for the shafts of motor and load, from the topic ~/command."""

from __future__ import annotations

import math
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterable
from typing import NamedTuple

from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import JointState

from planetary_twin_py import Scene, Twin
from planetary_twin_py.recording.ros2.given import SIDES, joint_names, values_of
from planetary_twin_py.run.commands import Command
from planetary_twin_py.scene.drive import Ports
from planetary_twin_py.text.escaping import one_line

from ..base.diagnostics import Row
from .diagnostics.commands import CommandReport
from .input_brake import InputBrake, for_ports
from .parameters import SimulationSettings

_TURN = 2.0 * math.pi
_OUT_OF_RANGE = "out of range"
_NOT_TAKEN = "not taken"
_MOST_NAMES = 3  # in a message
_LONGEST_NAME = 40  # characters
_AHEAD = 1_000_000_000  # [ns] by which stamps may be ahead: clocks of two computers differ
QOS = QoSProfile(depth=200, reliability=ReliabilityPolicy.BEST_EFFORT)
"""QoS of ~/command: it matches reliable and best-effort publishers, and holds what several fast
clients send within an interval."""


class _Arrived(NamedTuple):
    """The newest command of a shaft."""

    values: dict[str, float]
    time: float  # [s] steady clock


class ShaftCommands:
    """
    Takes commands in the thread of the twin and passes on the newest one of each joint.

    Joints are independent of one another, so each can have its own client. A stamped command has
    no effect if it is not newer than the last one of its joint, older than the timeout, or more
    than a second ahead. A command without a stamp acts in the order of arrival. A command without
    effect does not end a silence. `now` returns the ROS time of the stamps [ns]. `take` returns
    the messages that have arrived since its last call, with their times of arrival by the system
    clock [ns].
    """

    def __init__(
        self,
        scene: Scene,
        settings: SimulationSettings,
        now: Callable[[], int],
        take: Callable[[], Iterable[tuple[int, JointState]]],
    ) -> None:
        self.joints = joint_names(scene)
        self._timeout, self._silence = settings.command_timeout, settings.command_silence
        self._continuous = settings.continuous_joints
        self._now, self._take = now, take
        self._lock = threading.Lock()
        self._arrived: dict[str, _Arrived] = {}  # by side, since the last interval
        self._newest = dict.fromkeys(SIDES, 0)  # [ns] stamps of the last commands
        self._accepted: dict[str, float] = {}  # [s] arrivals of the last accepted commands
        self._before: dict[str, float] = {}  # those before the last interval
        self._open: dict[str, str] = {}  # joints at ports that have had no command, by side
        self._brake = InputBrake()
        self._report = CommandReport(self.joints)

    @property
    def ignored(self) -> Counter[str]:
        """Messages without effect, by reason."""
        return self._report.ignored

    def collect(self) -> None:
        """Take the commands that have arrived; a defect in this makes the joints silent."""
        try:
            for arrival, message in self._take():
                self.receive(message, max(time.time_ns() - arrival, 0))
        except Exception as defect:
            self._report.ignore(_NOT_TAKEN, f"{type(defect).__name__}: {defect}")

    def receive(self, message: JointState, waited: int = 0) -> None:
        """
        Take a command, unless it is late, ahead, repeated or out of order.

        `waited` is the time since its arrival [ns].
        """
        stamp = message.header.stamp.sec * 1_000_000_000 + message.header.stamp.nanosec
        values, now = values_of(message, self.joints), self._now() - waited if stamp else 0
        reasons = dict[str, str]()  # with details
        if fault := fault_of_names(message, self.joints):
            values = {}
            reasons[fault] = ""
        elif not values:
            reason = f"no effort, velocity or position of {' or '.join(self.joints)}"
            reasons[reason] = names_given(message)
        with self._lock:
            for side in SIDES:
                own = {name: value for name, value in values.items() if name.startswith(side)}
                faults = self._fault_of_stamp(side, stamp, now) if own else {}
                if faults:
                    reasons |= faults
                elif own:
                    self._newest[side] = stamp or self._newest[side]
                    self._arrived[side] = _Arrived(own, time.monotonic() - 1e-9 * waited)
        self._report.look_at(message)
        for reason, detail in reasons.items():
            self._report.ignore(reason, detail)

    def _fault_of_stamp(self, side: str, stamp: int, now: int) -> dict[str, str]:
        """Return why a command has no effect, with the figures of its stamp; or nothing."""
        if not stamp:
            return {}
        age, newest = now - stamp, self._newest[side]
        if -age > _AHEAD:
            detail = f"stamp {_seconds(-age)} ahead, at most {_seconds(_AHEAD)}"
            return {"ahead of the clock": detail}
        if self._timeout and age > 1e9 * self._timeout:
            return {"late": f"{_seconds(age)} old, command_timeout = {self._timeout:g} s"}
        # A newest stamp ahead of the clock shows that the clock was set back: ignore it.
        if stamp <= newest <= now + _AHEAD:
            detail = f"stamp {_seconds(newest - stamp)} before that of the last command"
            return {"repeated or out of order": detail}
        return {}

    def row(self) -> Row:
        """Return the report on commands for `/diagnostics`."""
        with self._lock:
            silent = self._silent()
            without = [joint for side, joint in self._open.items() if side not in self._arrived]
            received = bool(self._accepted or self._arrived)
        reaction = ""
        if silent:
            names = dict(zip(SIDES, self.joints, strict=True))
            joints = " and ".join(names[side] for side in silent)
            reaction = f"no command for {joints} for {max(silent.values()):.1f} s: {self._silence}"
        braking = bool(silent) and self._silence == "brake"
        return self._report.row(reaction, without, received, braking)

    def _silent(self) -> dict[str, float]:
        """Return the sides without a command for longer than the timeout, and for how long [s]."""
        now = time.monotonic()
        silent = {side: now - accepted for side, accepted in self._accepted.items()}
        return {side: t for side, t in silent.items() if self._timeout and t > self._timeout}

    def given(self, twin: Twin, interval: float) -> dict[str, float]:
        """
        Return the commands from the present time of `twin` on, as arguments of `Twin.advance`.

        `interval` [s] is that of a running twin. It is 0 for a step of a paused twin, in which
        commands cannot be missing.
        """
        self.collect()
        ports = self._brake.ports(twin)
        if ports.given:
            self._watch_speeds(twin)
        with self._lock:
            arrived, self._arrived = self._arrived, {}
        taken = {
            side: self._taken(side, each.values, twin, ports, interval)
            for side, each in arrived.items()
        }
        with self._lock:
            self._before = dict(self._accepted)
            self._accepted |= {side: arrived[side].time for side, own in taken.items() if own}
            self._watch(ports)
            silent = self._silent() if interval else {}
        if silent and self._silence == "brake":
            self._brake.begin(twin)
            return {}
        if any(taken.values()):
            self._brake.release(twin)
        given = {name: value for own in taken.values() for name, value in own.items()}
        if silent and self._silence == "zero":
            names = (f"{side}_{quantity}" for side in silent for quantity in ("torque", "speed"))
            given |= for_ports(dict.fromkeys(names, 0.0), ports)
        return given

    def refuse(self, reason: str) -> None:
        """Count the commands that `given` has returned last: the twin has refused them."""
        self._report.ignore(_OUT_OF_RANGE, reason)
        with self._lock:
            self._accepted = self._before

    def release(self, twin: Twin) -> None:
        """End a brake: restore the ports of `twin`."""
        self._brake.release(twin)

    def _watch(self, ports: Ports) -> None:
        """Ignore machines in the timeout; a new port is monitored from its first command on."""
        given = [side for side, port in zip(SIDES, ports, strict=True) if port != "machine"]
        self._accepted = {side: t for side, t in self._accepted.items() if side in given}
        names = dict(zip(SIDES, self.joints, strict=True))
        self._open = {side: names[side] for side in given if side not in self._accepted}

    def _watch_speeds(self, twin: Twin) -> None:
        """Report a shaft that turns faster than its commands may demand."""
        states = twin.port_states
        for side, most in zip(SIDES, twin.speed_limits, strict=True):
            speed = abs(getattr(states, f"{side}_speed"))
            if speed > most:
                self._report.exceed(
                    side,
                    f"speed of the {side} shaft = {speed:.4g} rad/s: exceeds {most:.4g} rad/s, "
                    "from drive.speed_limit",
                )

    def _taken(
        self, side: str, values: dict[str, float], twin: Twin, ports: Ports, interval: float
    ) -> dict[str, float]:
        """Return those `values` of a side that its port accepts; count them if there are none."""
        taken = for_ports(values, ports)
        if not taken:
            joint = self.joints[SIDES.index(side)]
            self._report.ignore(f"{joint}: drive.{side}.port = {getattr(ports, side)}")
            return {}
        if not self._continuous:
            taken = nearest_turn(taken, twin)
        try:
            twin.check_command(Command(**taken), ports, interval)
        except ValueError as refusal:
            self._report.ignore(_OUT_OF_RANGE, str(refusal))
            return {}
        return taken


def _seconds(nanoseconds: int) -> str:
    return f"{nanoseconds * 1e-9:.3g} s"


def nearest_turn(values: dict[str, float], twin: Twin) -> dict[str, float]:
    """Return `values`, with whole turns added to positions: nearest to the shafts of `twin`."""
    near = dict(values)
    for side in SIDES:
        name = f"{side}_position"
        if name in near:
            angle = getattr(twin.port_states, f"{side}_angle")
            near[name] += _TURN * round((angle - near[name]) / _TURN)
    return near


def names_given(message: JointState) -> str:
    """Return the names of a command, for a message: the first ones of many."""
    shown = [repr(one_line(name, _LONGEST_NAME)) for name in message.name[:_MOST_NAMES]]
    more = ["..."] if len(message.name) > _MOST_NAMES else []
    return f"the command names {', '.join(shown + more)}" if shown else "the command has no name"


def fault_of_names(message: JointState, joints: tuple[str, str]) -> str:
    """
    Return what is wrong with the names of `message`; ros2_control sends no surplus values.

    Names other than those of `joints` may repeat: they have no effect.
    """
    longest = max(len(message.position), len(message.velocity), len(message.effort))
    if longest > len(message.name):
        return "more values than names"
    names = list(message.name)
    return "a name twice" if any(names.count(joint) > 1 for joint in joints) else ""
