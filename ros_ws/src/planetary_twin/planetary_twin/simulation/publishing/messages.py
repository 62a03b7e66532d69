"""
Fills the twin's messages in place: creating them each time would cost more than sending them.

Stamps are set when a message is sent: `fill` returns the simulated instant [s] of the stamps, or
None if there is nothing to send for a window.
"""

from __future__ import annotations

from array import array
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray
from planetary_twin_msgs import msg
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState

from planetary_twin_py import Scene, Window
from planetary_twin_py.recording.ros2.fields import (
    TURN,
    mesh_fields,
    state_numbers,
    state_of_planets,
)
from planetary_twin_py.recording.ros2.given import fields_of
from planetary_twin_py.recording.ros2.point import point_fields
from planetary_twin_py.run.twin import Change

from ...base.damage import fill
from ..damage import SimulatedDamage
from .whole_turns import WholeTurns


class StateMessage:
    """GearboxState of `scene` in `frame`; entries beyond the number of planets stay NaN."""

    def __init__(self, scene: Scene, frame: str) -> None:
        planets = scene.gearset.planets
        self.message = msg.GearboxState(planets=planets)
        self.message.header.frame_id = frame
        self.stamps = [self.message.header.stamp]
        names = self.message.get_fields_and_field_types()
        for name, kind in names.items():
            if kind == "double[7]":
                getattr(self.message, name)[:] = np.nan
        self._meshes = mesh_fields(names, planets)
        self._of_planets = {
            name: getattr(self.message, name)[:planets]
            for name in ("planet_angle", "planet_speed", *(field.name for field in self._meshes))
        }

    def fill(self, window: Window) -> float:
        """Fill the message for `window`."""
        message = self.message
        message.sequence += 1
        message.tolerance = window.tolerance
        message.sample_rate = window.sample_rate
        for name, value in state_numbers(window).items():
            setattr(message, name, value)
        for name, values in state_of_planets(window, self._meshes).items():
            self._of_planets[name][:] = values
        return window.end


class IntervalMessage:
    """A message of type `kind` in `frame`, with the fields that `fields` returns for a window."""

    def __init__(self, kind: type, frame: str, fields: Callable[[Window], dict[str, Any]]) -> None:
        self.message = kind()
        self.message.header.frame_id = frame
        self.stamps = [self.message.header.stamp]
        self._fields = fields

    def fill(self, window: Window) -> float | None:
        """Fill the message for `window`; arrays of the same length keep their memory."""
        self.message.sequence += 1
        for name, value in self._fields(window).items():
            before = getattr(self.message, name)
            if not isinstance(value, np.ndarray):
                setattr(self.message, name, value)
            elif len(before) == len(value):
                np.frombuffer(before, value.dtype)[:] = value
            else:
                setattr(self.message, name, array(value.dtype.char, value.tobytes()))
        return window.end


class WaveMessage(IntervalMessage):
    """The samples of an interval; a single step may be shorter than the sample period."""

    def fill(self, window: Window) -> float | None:
        """Fill the message for `window`."""
        if not len(window.waveform.time):
            return None
        super().fill(window)
        return float(self.message.start_time)


class JointsMessage:
    """
    JointState with a joint `<body>_joint` for each body; positions are absolute angles.

    Efforts are the mean torques on the shafts of motor and load, NaN for bodies without a shaft.
    Positions are within one turn. If `continuous`, they count whole turns from the start of the
    run. The URDF in `robot_description` attaches the planets such that absolute angles move them
    correctly.
    """

    def __init__(self, continuous: bool) -> None:
        self.message = JointState()
        self.stamps = [self.message.header.stamp]
        self._values: list[NDArray[np.float64]] = []  # the memory of the message's arrays
        self._turns = WholeTurns() if continuous else None

    def fill(self, window: Window) -> float:
        """Fill the message for `window`."""
        if not self._values:
            self.message.name = [f"{body}_joint" for body in window.bodies]
            for field in ("position", "velocity", "effort"):
                setattr(self.message, field, array("d", bytes(8 * len(window.bodies))))
                self._values.append(np.frombuffer(getattr(self.message, field)))
        turns = self._turns.after(window) if self._turns else 0.0
        position, velocity, effort = self._values
        position[:] = window.angle + TURN * turns
        velocity[:] = window.mean_speed
        effort[:] = window.shaft_torque
        return window.end


class GivenMessage:
    """JointState with the commands that acted at the ports, of the joints of both shafts."""

    def __init__(self, shafts: tuple[str, str]) -> None:
        self.message = JointState()
        self.stamps = [self.message.header.stamp]
        self._shafts = shafts

    def fill(self, window: Window) -> float | None:
        """Fill the message for `window`, if there were commands."""
        if not window.given:
            return None
        for name, values in fields_of(window.given, self._shafts).items():
            setattr(self.message, name, values)
        return window.end


class DamageMessage:
    """DamageState or DamageTeeth of type `kind` in `frame`, when one is due on `topic`."""

    def __init__(self, kind: type, frame: str, damage: SimulatedDamage, topic: str) -> None:
        self.message = kind()
        self.message.header.frame_id = frame
        self.stamps = [self.message.header.stamp]
        self._damage, self._topic = damage, topic

    def fill(self, window: Window) -> float | None:
        """Fill the message after `window`, if it is due."""
        fields = self._damage.due(self._topic)
        if fields is None:
            return None
        self.message.sequence += 1
        fill(self.message, fields)
        return window.end


class ClockMessage:
    """The end of an interval for /clock."""

    def __init__(self) -> None:
        self.message = Clock()
        self.stamps = [self.message.clock]

    def fill(self, window: Window) -> float:
        """Return the end of `window` [s]."""
        return window.end


class OperatingPointMessage:
    """OperatingPoint in `frame`, with the names that differ from the previous message."""

    def __init__(self, frame: str) -> None:
        self.message = msg.OperatingPoint()
        self.message.header.frame_id = frame
        self._last: Mapping[str, Any] | None = None

    def fill(self, change: Change) -> msg.OperatingPoint:
        """Return the message for operating point and ports after `change`."""
        message, values = self.message, change.values
        message.sequence += 1
        message.simulated_time = change.time
        worsened, oil = change.worsened, change.oil_temperature
        for name, value in point_fields(values, self._last, worsened, oil).items():
            setattr(message, name, value)
        self._last = values
        return message
