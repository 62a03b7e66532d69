"""What the twin shows of a stretch of time: a waveform, and statistics over it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from .dynamics.bodies import LOAD_MACHINE, MOTOR, SECOND_MOTOR
from .dynamics.observe import (
    BOUNDARY,
    DTE,
    FILM,
    LAMBDA,
    MESH_FORCE,
    POWER_LOSS,
    VISCOUS,
)


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
    """One stretch of simulated time. Means are over the stretch, angles stand at its end."""

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


class Stretch(NamedTuple):
    """What `observe` sees of a stretch of time at instants of it, its first and last included."""

    instants: np.ndarray
    """[s] from anywhere, not falling, shape (instants,)"""
    mesh: Sequence[np.ndarray]
    """By quantity, shape (instants, meshes) each."""


def mesh_statistics(stretch: Stretch) -> dict[str, np.ndarray]:
    """Mean, rms and peak over a stretch of time, shape (meshes,) each.

    Means are over time, by trapezoids from instant to instant: they do not depend on how many
    samples happen to fall into the stretch. rms is that of the deviation from the mean, peak the
    largest magnitude; film and lambda ratio are means over the time in contact, NaN without any.
    `without_viscous` is the share of the time in which teeth are in contact but have no viscous
    friction.
    """
    dte, force = stretch.mesh[DTE], stretch.mesh[MESH_FORCE]
    touching, viscous = force != 0.0, stretch.mesh[VISCOUS]
    weights = _trapezoids(stretch.instants)
    dte_mean = _mean(dte, weights)
    return {
        "dte_mean": dte_mean,
        "dte_rms": np.sqrt(_mean(np.square(dte - dte_mean), weights)),
        "dte_peak": np.abs(dte).max(axis=0),
        "mesh_force_mean": _mean(force, weights),
        "mesh_force_peak": np.abs(force).max(axis=0),
        "contact_fraction": _mean(touching.astype(float), weights),
        "without_viscous": _mean((touching & (viscous == 0.0)).astype(float), weights),
        "film_thickness": _mean_in_contact(stretch.mesh[FILM], weights),
        "lambda_ratio": _mean_in_contact(stretch.mesh[LAMBDA], weights),
        "boundary_friction": _mean(stretch.mesh[BOUNDARY], weights),
        "viscous_friction": _mean(viscous, weights),
        "power_loss": _mean(stretch.mesh[POWER_LOSS], weights),
    }


def _trapezoids(instants: np.ndarray) -> np.ndarray:
    """Share of the stretch for which each instant stands, a column that sums up to 1."""
    if len(instants) == 1:
        return np.ones((1, 1))
    gaps = np.diff(instants, prepend=instants[0], append=instants[-1])
    return np.asarray(0.5 * (gaps[:-1] + gaps[1:]) / (instants[-1] - instants[0]))[:, None]


def _mean(values: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """By column."""
    return np.asarray((weights * values).sum(axis=0))


def _mean_in_contact(values: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Mean of the rows that are numbers, by column; NaN without any."""
    sound = ~np.isnan(values)
    with np.errstate(invalid="ignore"):
        return _mean(np.where(sound, values, 0.0), weights) / _mean(sound.astype(float), weights)
