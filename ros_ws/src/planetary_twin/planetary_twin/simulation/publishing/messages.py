"""
Fills the twin's messages in place: creating them each time would cost more than sending them.

Stamps are set when a message is sent.
"""

from __future__ import annotations

from array import array
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from planetary_twin_msgs import msg
from sensor_msgs.msg import JointState

from planetary_twin_py import Scene, Window
from planetary_twin_py.recording.ros2.fields import (
    TURN,
    mesh_fields,
    state_numbers,
    state_of_planets,
)
from planetary_twin_py.recording.ros2.point import point_fields
from planetary_twin_py.run.twin import Change

from .whole_turns import WholeTurns


class StateMessage:
    """GearboxState of `scene` in `frame`; entries beyond the number of planets stay NaN."""

    def __init__(self, scene: Scene, frame: str) -> None:
        planets = scene.gearset.planets
        self.message = msg.GearboxState(planets=planets)
        self.message.header.frame_id = frame
        names = self.message.get_fields_and_field_types()
        for name, kind in names.items():
            if kind == "double[7]":
                getattr(self.message, name)[:] = np.nan
        self._meshes = mesh_fields(names, planets)
        self._of_planets = {
            name: getattr(self.message, name)[:planets]
            for name in ("planet_angle", "planet_speed", *(field.name for field in self._meshes))
        }

    def fill(self, window: Window) -> msg.GearboxState:
        """Return the message for `window`."""
        message = self.message
        message.sequence += 1
        message.tolerance = window.tolerance
        message.sample_rate = window.sample_rate
        for name, value in state_numbers(window).items():
            setattr(message, name, value)
        for name, values in state_of_planets(window, self._meshes).items():
            self._of_planets[name][:] = values
        return message


class IntervalMessage:
    """A message of type `kind` in `frame`, with the fields that `fields` returns for a window."""

    def __init__(self, kind: type, frame: str, fields: Callable[[Window], dict[str, Any]]) -> None:
        self.message = kind()
        self.message.header.frame_id = frame
        self._fields = fields

    def fill(self, window: Window) -> Any:
        """Return the message for `window`; arrays of the same length keep their memory."""
        self.message.sequence += 1
        for name, value in self._fields(window).items():
            before = getattr(self.message, name)
            if not isinstance(value, np.ndarray):
                setattr(self.message, name, value)
            elif len(before) == len(value):
                np.frombuffer(before, value.dtype)[:] = value
            else:
                setattr(self.message, name, array(value.dtype.char, value.tobytes()))
        return self.message


class JointsMessage:
    """
    JointState with a joint `<body>_joint` for each body; positions are absolute angles.

    Efforts are the mean torques on the shafts of motor and load, NaN for bodies without a shaft.
    Positions are within one turn. If `continuous`, they count whole turns from the start of the
    run. The URDF in `robot_description` attaches the planets such that absolute angles move them
    correctly.
    """

    def __init__(self, bodies: tuple[str, ...], continuous: bool) -> None:
        size = bytes(8 * len(bodies))
        self.message = JointState(
            name=[f"{body}_joint" for body in bodies],
            position=array("d", size),
            velocity=array("d", size),
            effort=array("d", size),
        )
        self._position = np.frombuffer(self.message.position)
        self._velocity = np.frombuffer(self.message.velocity)
        self._effort = np.frombuffer(self.message.effort)
        self._turns = WholeTurns() if continuous else None

    def fill(self, window: Window) -> JointState:
        """Return the message for `window`."""
        turns = self._turns.after(window) if self._turns else 0.0
        self._position[:] = window.angle + TURN * turns
        self._velocity[:] = window.mean_speed
        self._effort[:] = window.shaft_torque
        return self.message


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
        for name, value in point_fields(values, self._last).items():
            setattr(message, name, value)
        self._last = values
        return message
