"""Initial state of a run: quasi-static equilibrium at the operating point.

Flanks carry the mean torque, couplings are deflected, and the torques are trimmed for the mean
friction of one mesh cycle. So the run is steady from the start, except for the vibration that the
meshes excite.
"""

from __future__ import annotations

from .._core import (
    BY_MACHINE,
    BY_MOTION,
    BY_TORQUE,
    Load,
    Model,
    PortStates,
    State,
    Train,
)
from ..integrators.clock import Instant
from ..scene import OperatingPoint, Scene
from .bodies import MOTOR
from .library import library
from .speed_loop import bandwidth, speed_loop_gains
from .static_load import mesh_force, static_torques

_CAUSALITIES = {"machine": BY_MACHINE, "torque": BY_TORQUE, "motion": BY_MOTION}


class LoadBuilder:
    """Builds the loads of a train for any operating point.

    Args:
        scene: scene of the drive.
        train: of `build_train`.
    """

    def __init__(self, scene: Scene, train: Train) -> None:
        control = scene.drive.speed_control
        gains = speed_loop_gains(scene, train, bandwidth(scene))
        self._mesh, self._angle = scene.mesh, scene.gearset.pressure_angle
        self._axes, self._torques = train.axes, static_torques(scene)
        self._constant = Load(
            release=1.0 if scene.mesh.backlash == "dead_zone" else 0.0,
            slew_rate=control.slew_rate,
            ripple_order=float(control.ripple_order),
            inertia=gains.inertia,
            proportional=gains.proportional,
            trim_gain=gains.trim,
            load_proportional=gains.load_proportional,
            port=[_CAUSALITIES[port] for port in scene.drive.ports],
        )
        self._start_speed = control.start_speed
        self._ratios = train.ratio[train.coupling[: len(scene.drive.ports), 0], 0]

    def build(self, point: OperatingPoint) -> Load:
        """Loads at an operating point.

        Given torques and speeds are those of steady running there.
        """
        load = self._constant.copy()
        half, offset = self._mesh.flanks(point.backlash, self._angle)
        load.half_backlash, load.offset = half, offset
        load.inner_squared = (half - offset) ** 2
        load.target_speed = [point.input_speed, point.second_input_speed][: self._axes]
        load.torque = point.input_torque * self._torques
        load.ripple = point.torque_ripple
        started = self._start_speed
        load.speed = self._ratios * (point.input_speed if started is None else started)
        return load


def keep_given(before: Load, load: Load) -> None:
    """Let given torques and motions stay as they were before a change of other loads."""
    torque, rate = load.torque.copy(), load.torque_rate.copy()
    given = before.port == BY_TORQUE
    torque[given], rate[given] = before.torque[given], before.torque_rate[given]
    load.torque, load.torque_rate = torque, rate
    load.speed, load.acceleration = before.speed, before.acceleration
    load.since_seconds, load.since = before.since_seconds, before.since


def begin_given(load: Load, now: Instant, shown: PortStates) -> None:
    """Let given torques and motions begin as the ports show them at `now`."""
    torque = load.torque.copy()
    for port, value in enumerate((shown.input_torque, shown.output_torque)):
        if load.port[port] == BY_TORQUE:
            torque[port] = value
    load.torque, load.speed = torque, [shown.input_speed, shown.output_speed]
    load.since_seconds, load.since = now


def build_load(scene: Scene, point: OperatingPoint, train: Train) -> Load:
    """Loads on the train at an operating point."""
    return LoadBuilder(scene, train).build(point)


def start_state(scene: Scene, model: Model) -> State:
    """State at the start of a run, at time zero and motor angle zero."""
    speed = model.load.target_speed.copy()
    if scene.drive.speed_control.start_speed is not None:
        speed[0] = scene.drive.speed_control.start_speed
    force = mesh_force(scene, float(model.load.torque[MOTOR]))
    state: State = library(scene).initial_state(model, speed, force)
    return state
