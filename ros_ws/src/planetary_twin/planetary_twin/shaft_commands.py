"""Commands for the shafts of motor and load, from the topic ~/command."""

from __future__ import annotations

import math
import threading
import time
from collections import Counter
from typing import Protocol

from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from rclpy.clock import Clock
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import JointState

from planetary_twin_py import Scene, Twin
from planetary_twin_py.recording.ros2.given import SIDES, joint_names, values_of
from planetary_twin_py.recording.ros2.topics import status_name

COMMANDS = "simulation: commands"
SILENCE = ("hold", "zero", "brake")
"""What acts if no command arrives: the last one, nothing, or a brake on the input shaft."""
_QUANTITIES = {"torque": "torque", "motion": "speed"}  # that are given
# Subscribers of this reliability match publishers of both.
_QOS = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)


class Given(Protocol):
    """Parameters of the commands."""

    scene: Scene
    command_timeout: float
    command_silence: str


def for_ports(values: dict[str, float], twin: Twin) -> dict[str, float]:
    """Return those `values` that are given at the ports of `twin`."""
    sides = zip(SIDES, twin.ports, strict=True)
    names = [f"{side}_{_QUANTITIES[port]}" for side, port in sides if port in _QUANTITIES]
    return {name: values[name] for name in names if name in values}


class ShaftCommands:
    """
    Receives commands and hands the newest one to the thread of the twin.

    A stamped command that is not newer than the last one, or older than the timeout, has no
    effect; one without a stamp acts in the order of arrival. `clock` gives the time of the stamps.
    """

    def __init__(self, given: Given, clock: Clock) -> None:
        self.joints = joint_names(given.scene)
        self.ignored = Counter[str]()
        """Messages without effect, by reason."""
        self._timeout, self._silence = given.command_timeout, given.command_silence
        self._clock = clock
        self._lock = threading.Lock()
        self._values: dict[str, float] = {}
        self._newest = 0  # [ns] stamp of the last command
        self._received = math.inf  # [s] steady clock; before the first command there is no silence
        self._brake = _Brake()

    @property
    def qos(self) -> QoSProfile:
        """Return the quality of service of the subscription."""
        return _QOS

    def receive(self, message: JointState) -> None:
        """Take a command, unless it is late, repeated or out of order."""
        stamp = message.header.stamp.sec * 1_000_000_000 + message.header.stamp.nanosec
        reason = self._fault(stamp)
        values = values_of(message, self.joints)
        if not values and not reason:
            reason = f"no effort or velocity of {' or '.join(self.joints)}"
        if reason:
            with self._lock:
                self.ignored[reason] += 1
            return
        with self._lock:
            self._newest = stamp or self._newest
            self._values |= values
            self._received = time.monotonic()

    def status(self, hardware: str) -> DiagnosticStatus:
        """Return the report on commands for `/diagnostics`; `hardware` is the namespace."""
        with self._lock:
            silent = time.monotonic() - self._received
            ignored = dict(self.ignored)
        late = bool(self._timeout) and silent > self._timeout
        message = f"no command for {silent:.1f} s: {self._silence}" if late else "received"
        if silent == -math.inf:
            message = "no command yet"
        return DiagnosticStatus(
            level=DiagnosticStatus.WARN if late or ignored else DiagnosticStatus.OK,
            name=status_name(COMMANDS, hardware),
            message=message,
            hardware_id=hardware,
            values=[KeyValue(key=f"ignored: {why}", value=str(n)) for why, n in ignored.items()],
        )

    def _fault(self, stamp: int) -> str:
        if not stamp:
            return ""
        if stamp <= self._newest:
            return "repeated or out of order"
        if self._timeout and self._clock.now().nanoseconds - stamp > 1e9 * self._timeout:
            return "late"
        return ""

    def given(self, twin: Twin, interval: float) -> dict[str, float]:
        """
        Return what is given from the present time of `twin` on, as arguments of `Twin.advance`.

        `interval` [s] is that of a running twin; a step of a paused one, 0, has no silence.
        """
        with self._lock:
            values, self._values = self._values, {}
            silent = time.monotonic() - self._received
        if values:
            self._brake.release(twin)
            return for_ports(values, twin)
        if not self._timeout or silent <= self._timeout or not interval:
            return {}
        if self._silence == "zero":
            return for_ports(_ZERO, twin)
        if self._silence == "brake":
            return self._brake.slow(twin, interval)
        return {}


_ZERO = dict.fromkeys(("input_torque", "output_torque", "input_speed", "output_speed"), 0.0)


class _Brake:
    """Brings the input shaft to rest at the slew rate of the drive, and holds it."""

    def __init__(self) -> None:
        self._before: tuple[str, str] | None = None  # ports without the brake

    def slow(self, twin: Twin, interval: float) -> dict[str, float]:
        """Return the speed that the input shaft has in the next `interval` [s]."""
        if not twin.ports.given:
            return {}
        if self._before is None:
            self._before = twin.ports
            twin.set_ports(input="motion", output=_braked(twin.ports.output))
        speed = twin.port_states.input_speed
        less = twin.scene.drive.speed_control.slew_rate * interval
        slower = math.copysign(max(abs(speed) - less, 0.0), speed)
        return for_ports({"input_speed": slower, "output_torque": 0.0}, twin)

    def release(self, twin: Twin) -> None:
        """Let the ports be as they were."""
        if self._before is not None:
            twin.set_ports(*self._before)
            self._before = None


def _braked(port: str) -> str:
    """Return the causality of the output while the input is at rest: nothing drives it."""
    return "torque" if port == "motion" else port
