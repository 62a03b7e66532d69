"""
Fills the twin's messages in place: creating them each time would cost more than sending them.

Stamps are set when a message is sent.
"""

from __future__ import annotations

from array import array
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray
from planetary_twin_msgs import msg
from sensor_msgs.msg import JointState

from planetary_twin_py import Scene, Window
from planetary_twin_py.recording.ros2.fields import MEMBERS, TURN, mesh_field
from planetary_twin_py.recording.ros2.point import point_fields
from planetary_twin_py.run.twin import Change
from planetary_twin_py.units.catalogue import TRAIN, WAVEFORM

from .whole_turns import WholeTurns


class StateMessage:
    """GearboxState of `scene` in `frame`; entries beyond the number of planets stay NaN."""

    def __init__(self, scene: Scene, frame: str) -> None:
        self.message = msg.GearboxState(planets=scene.gearset.planets)
        self.message.header.frame_id = frame
        names = self.message.get_fields_and_field_types()
        for name, kind in names.items():
            if kind == "double[7]":
                getattr(self.message, name)[:] = np.nan
        self._planets = scene.gearset.planets
        self._mesh = [
            (getattr(self.message, name)[: self._planets], *shown)
            for name in names
            if (shown := mesh_field(name, self._planets))
        ]

    def fill(self, window: Window) -> msg.GearboxState:
        """Return the message for `window`."""
        message = self.message
        message.sequence += 1
        message.simulated_time = window.end
        message.interval = window.end - window.start
        message.tolerance = window.tolerance
        message.sample_rate = window.sample_rate
        for name in MEMBERS:
            body = window.bodies.index(name)
            setattr(message, f"{name}_angle", float(window.angle[body]))
            setattr(message, f"{name}_speed", float(window.mean_speed[body]))
        first = window.bodies.index("planet_1")
        planets = slice(first, first + self._planets)
        message.planet_angle[: self._planets] = window.angle[planets]
        message.planet_speed[: self._planets] = window.mean_speed[planets]
        for name in TRAIN:
            setattr(message, name, float(getattr(window, name)))
        for target, name, first in self._mesh:
            end = first + self._planets
            target[:] = window.mesh[name][first:end]
        return message


class WaveformMessage:
    """MeshWaveform of `scene` in `frame`."""

    def __init__(self, scene: Scene, frame: str) -> None:
        planets = scene.gearset.planets
        self.message = msg.MeshWaveform(planets=planets)
        self.message.header.frame_id = frame
        self._meshes = 2 * planets
        self._views: list[NDArray[np.float32]] = []

    def fill(self, window: Window) -> msg.MeshWaveform:
        """Return the message for `window`."""
        wave, message = window.waveform, self.message
        if message.samples != len(wave.time):
            self._allocate(len(wave.time))
        message.sequence += 1
        message.start_time = float(wave.time[0])
        message.sample_period = wave.period
        for view, name in zip(self._views, WAVEFORM, strict=True):
            view[:] = getattr(wave, name).T
        return message

    def _allocate(self, samples: int) -> None:
        self.message.samples = samples
        self._views = []
        for name in WAVEFORM:
            values = array("f", bytes(4 * self._meshes * samples))
            setattr(self.message, name, values)
            # The view shares the memory of the message.
            view = np.frombuffer(getattr(self.message, name), dtype=np.float32)
            self._views.append(view.reshape(self._meshes, samples))


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
