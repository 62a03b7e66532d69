"""Commands for the shafts of motor and load, from the topic ~/command."""

from __future__ import annotations

import math
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import JointState

from planetary_twin_py import Scene, Twin
from planetary_twin_py.recording.ros2.given import joint_names, values_of
from planetary_twin_py.run.commands import SIDES, Command
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


@dataclass
class _Shaft:
    """The commands for one shaft; times are those of the steady clock [s]."""

    side: str
    joint: str
    port: str = "machine"
    arrived: dict[str, float] = field(default_factory=dict)
    """The newest values since the last interval."""
    time: float = 0.0
    """Arrival of the newest command."""
    stamp: int = 0
    """Stamp of the last command [ns]."""
    accepted: float | None = None
    """Arrival of the last command that took effect, while the port is given."""
    before: float | None = None
    """The same, before the last interval."""

    def silence(self, timeout: float) -> float:
        """Return the time without a command [s] if it exceeds `timeout` [s], else 0."""
        passed = 0.0 if self.accepted is None else time.monotonic() - self.accepted
        return passed if timeout and passed > timeout else 0.0


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
        self._shafts = [_Shaft(*names) for names in zip(SIDES, self.joints, strict=True)]
        self._timeout, self._silence = settings.command_timeout, settings.command_silence
        self._continuous = settings.continuous_joints
        self._now, self._take = now, take
        self._lock = threading.Lock()
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
            for shaft in self._shafts:
                own = {name: v for name, v in values.items() if name.startswith(shaft.side)}
                faults = self._fault_of_stamp(shaft, stamp, now) if own else {}
                if faults:
                    reasons |= faults
                elif own:
                    shaft.arrived, shaft.stamp = own, stamp or shaft.stamp
                    shaft.time = time.monotonic() - 1e-9 * waited
        self._report.look_at(message)
        for reason, detail in reasons.items():
            self._report.ignore(reason, detail)

    def _fault_of_stamp(self, shaft: _Shaft, stamp: int, now: int) -> dict[str, str]:
        """Return why a command has no effect, with the figures of its stamp; or nothing."""
        if not stamp:
            return {}
        age, newest = now - stamp, shaft.stamp
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
            silent = {shaft.joint: shaft.silence(self._timeout) for shaft in self._shafts}
            without = [
                shaft.joint
                for shaft in self._shafts
                if shaft.port != "machine" and shaft.accepted is None and not shaft.arrived
            ]
            received = any(each.arrived or each.accepted is not None for each in self._shafts)
        reaction = ""
        if longest := max(silent.values()):
            joints = " and ".join(joint for joint, seconds in silent.items() if seconds)
            reaction = f"no command for {joints} for {longest:.1f} s: {self._silence}"
        braking = bool(reaction) and self._silence == "brake"
        return self._report.row(reaction, without, received, braking)

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
            given = self._accept(twin, ports, interval)
            silent = [shaft.side for shaft in self._shafts if shaft.silence(self._timeout)]
        if not interval:
            silent = []
        if silent and self._silence == "brake":
            self._brake.begin(twin)
            return {}
        if given:
            self._brake.release(twin)
        if silent and self._silence == "zero":
            names = (f"{side}_{quantity}" for side in silent for quantity in ("torque", "speed"))
            given |= for_ports(dict.fromkeys(names, 0.0), ports)
        return given

    def _accept(self, twin: Twin, ports: Ports, interval: float) -> dict[str, float]:
        """Return what the `ports` take of the commands that have arrived."""
        given: dict[str, float] = {}
        for shaft, port in zip(self._shafts, ports, strict=True):
            shaft.port, shaft.before = port, shaft.accepted
            if shaft.arrived:
                taken = self._taken(shaft, twin, ports, interval)
                shaft.accepted = shaft.time if taken else shaft.accepted
                shaft.arrived = {}
                given |= taken
            if port == "machine":  # a port that is given again waits for its first command
                shaft.accepted = None
        return given

    def refuse(self, reason: str) -> None:
        """Count the commands that `given` has returned last: the twin has refused them."""
        self._report.ignore(_OUT_OF_RANGE, reason)
        with self._lock:
            for shaft in self._shafts:
                shaft.accepted = shaft.before

    def release(self, twin: Twin) -> None:
        """End a brake: restore the ports of `twin`."""
        self._brake.release(twin)

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

    def _taken(self, shaft: _Shaft, twin: Twin, ports: Ports, interval: float) -> dict[str, float]:
        """Return the values of a shaft that its port accepts; count them if there are none."""
        taken = for_ports(shaft.arrived, ports)
        if not taken:
            self._report.ignore(f"{shaft.joint}: drive.{shaft.side}.port = {shaft.port}")
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
