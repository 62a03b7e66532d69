"""What the twin shows of a stretch of time: a waveform, and statistics over it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .accuracy import Course
from .dynamics.bodies import LOAD_MACHINE, MOTOR, SECOND_MOTOR
from .dynamics.mesh_sums import CLIPPED, CONTACT, FILMED, SQUARE, MeshSums
from .dynamics.observe import BOUNDARY, DTE, FILM, LAMBDA, MESH_FORCE, POWER_LOSS, VISCOUS


@dataclass(frozen=True)
class Waveform:
    """Every sample of every mesh; samples lie at whole multiples of the sample period."""

    period: float
    """From one sample to the next [s]."""
    time: np.ndarray
    """[s], shape (samples,)"""
    dte: np.ndarray
    """Dynamic transmission error along the line of action [m], shape (samples, meshes)."""
    mesh_force: np.ndarray
    """Normal force [N], negative on the coast flanks, shape (samples, meshes)."""
    friction: np.ndarray
    """Boundary and viscous friction, magnitude [N], shape (samples, meshes)."""


@dataclass(frozen=True)
class Window:
    """One stretch of simulated time. Angles stand at its end.

    Statistics of the meshes are over the window exactly. Powers and torques of the train are over
    the steps of the integrator that end within it: no window cuts a step short, so the path does
    not depend on the windows.
    """

    start: float
    """[s]"""
    end: float
    """[s]"""
    tolerance: float
    """Relative error of a step."""
    sample_rate: float
    """Of the waveform [Hz]."""
    repeated: bool
    """Whether it began in steady running that repeats itself and is not computed again."""
    bodies: tuple[str, ...]
    meshes: tuple[str, ...]
    waveform: Waveform
    mesh: dict[str, np.ndarray]
    """Statistics of the meshes, shape (meshes,) each: see `mesh_statistics`."""
    angle: np.ndarray
    """[rad] in [0, 2 pi), shape (bodies,)"""
    mean_speed: np.ndarray
    """[rad/s], shape (bodies,)"""
    mesh_frequency: float
    """Rate at which teeth pass a mesh [Hz]."""
    machine_speed: np.ndarray
    """Of the motor, the load, and the second motor of a differential [rad/s], (machines,)."""
    machine_torque: np.ndarray
    """Of each on its shaft [N m], (machines,)."""
    machine_power: np.ndarray
    """From each into the train [W], (machines,)."""
    power_loss: float
    """Tooth friction of all meshes, bearings and churning [W]."""
    stored_power: float
    """Rate at which kinetic and elastic energy grow [W]."""
    stored_energy: float
    """Kinetic and elastic energy at the end [J]."""
    residual_power: float
    """What does not add up of the energy ledger [W]: the error of the integration."""
    course: Course
    """What the accuracy is judged by, see `accuracy`."""

    @property
    def input_speed(self) -> float:
        """Of the motor [rad/s]."""
        return float(self.machine_speed[MOTOR])

    @property
    def input_torque(self) -> float:
        """Of the motor [N m]."""
        return float(self.machine_torque[MOTOR])

    @property
    def second_input_speed(self) -> float:
        """Of the second motor [rad/s], NaN without one."""
        return float(self.machine_speed[SECOND_MOTOR]) if self._differential else math.nan

    @property
    def second_input_torque(self) -> float:
        """Of the second motor [N m], NaN without one."""
        return float(self.machine_torque[SECOND_MOTOR]) if self._differential else math.nan

    @property
    def _differential(self) -> bool:
        return len(self.machine_speed) > SECOND_MOTOR

    @property
    def output_speed(self) -> float:
        """Of the load [rad/s]."""
        return float(self.machine_speed[LOAD_MACHINE])

    @property
    def output_torque(self) -> float:
        """Of the load on its shaft [N m]."""
        return float(self.machine_torque[LOAD_MACHINE])

    @property
    def input_power(self) -> float:
        """From the motors into the train [W]."""
        return float(self.machine_power[MOTOR] + self.machine_power[SECOND_MOTOR:].sum())

    @property
    def output_power(self) -> float:
        """From the train into the load [W]."""
        return -float(self.machine_power[LOAD_MACHINE])

    @property
    def efficiency(self) -> float:
        """1 - power_loss over the power of those machines that drive; NaN if none does."""
        put_in = float(np.maximum(self.machine_power, 0.0).sum())
        return 1.0 - self.power_loss / put_in if put_in > 0.0 else math.nan


def mesh_statistics(sums: MeshSums) -> dict[str, np.ndarray]:
    """Mean, rms and peak over a stretch of time, shape (meshes,) each.

    They come from the integrator, whatever samples are taken. rms is that of the deviation from
    the mean, peak the largest magnitude; film thickness and lambda ratio are means over the time
    in contact, NaN without any. `without_viscous` is the share of the time in which teeth carry
    load but have no viscous friction.

    Args:
        sums: of the meshes over the stretch, in the order of the result.
    """
    mean = sums.integral / sums.time
    with np.errstate(invalid="ignore"):
        film, lambda_ratio = mean[[FILM, LAMBDA]] / mean[FILMED]
    return {
        "dte_mean": mean[DTE],
        "dte_rms": np.sqrt(np.maximum(mean[SQUARE] - mean[DTE] ** 2, 0.0)),
        "dte_peak": sums.dte_peak,
        "mesh_force_mean": mean[MESH_FORCE],
        "mesh_force_peak": sums.force_peak,
        "contact_fraction": np.clip(mean[CONTACT], 0.0, 1.0),
        "without_viscous": np.clip(mean[CLIPPED], 0.0, 1.0),
        "film_thickness": film,
        "lambda_ratio": lambda_ratio,
        "boundary_friction": mean[BOUNDARY],
        "viscous_friction": mean[VISCOUS],
        "power_loss": mean[POWER_LOSS],
    }
