"""Result of a run: samples, energy ledger and statistics."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .dynamics.bodies import LOAD_MACHINE, MOTOR, SECOND_MOTOR


@dataclass(frozen=True)
class Energy:
    """Energy ledger of a run [J]: input = output + stored + lost - stiffness_work + residual."""

    machines: tuple[float, ...]
    """Work done on the train by the motor, the load, and the second motor of a differential."""
    kinetic: float
    """Increase of the kinetic energy."""
    elastic: float
    """Increase of the elastic energy of meshes and couplings."""
    friction: float
    """Dissipated by tooth friction."""
    damping: float
    """Dissipated by the damping of meshes and couplings."""
    bearing: float
    """Dissipated by bearings, seals and grease."""
    churning: float
    """Dissipated by oil churning."""
    stiffness_work: float
    """Work due to the change of mesh stiffness with the tooth pairs in contact."""
    stored: float
    """Kinetic and elastic energy at the end."""

    @property
    def input(self) -> float:
        """Work of the motors."""
        return self.machines[MOTOR] + sum(self.machines[SECOND_MOTOR:])

    @property
    def output(self) -> float:
        """Work done on the load."""
        return -self.machines[LOAD_MACHINE]

    @property
    def put_in(self) -> float:
        """Work of the driving machines."""
        return sum(max(work, 0.0) for work in self.machines)

    @property
    def residual(self) -> float:
        """Residual of the balance: the error of the integration."""
        lost = self.loss + self.damping - self.stiffness_work
        return self.input - self.output - self.kinetic - self.elastic - lost

    @property
    def loss(self) -> float:
        """Dissipated by tooth friction, bearings and churning."""
        return self.friction + self.bearing + self.churning


@dataclass(frozen=True)
class Stats:
    """Statistics of the integration."""

    steps: int
    """Computed steps."""
    repeated_steps: int
    """Steps that were not computed because the motion is periodic."""
    stiff_steps: int
    """Steps by Rosenbrock's method."""
    rejected_steps: int
    evaluations: int
    """Evaluations of the equations of motion."""
    pair_events: int
    """Starts and ends of the entry and exit of tooth pairs."""
    flank_events: int
    """Engagements and separations of flanks."""
    reversals: int
    """Steps in which vibration may have stopped or reversed a gear relative to the carrier."""
    both_flanks: int
    """Steps in which both flanks of a mesh touch; the model has a force on one of them only."""
    wall_time: float
    """[s]"""
    real_time_factor: float
    """Simulated time/wall time."""


@dataclass(frozen=True)
class Result:
    """Samples and energy ledger of a run; arrays are (samples,), (samples, bodies/meshes)."""

    duration: float
    """Time that the energy ledger covers [s]: from the end of the step in which settling ends to
    the end of the last step."""
    time: np.ndarray
    """[s]"""
    bodies: tuple[str, ...]
    meshes: tuple[str, ...]
    angle: np.ndarray
    """Absolute, counter-clockwise positive [rad], (samples, bodies)."""
    speed: np.ndarray
    """[rad/s], (samples, bodies)."""
    mean_speed: np.ndarray
    """Over the time of the samples [rad/s], (bodies,)."""
    dte: np.ndarray
    """Dynamic transmission error along the line of action [m], (samples, meshes)."""
    mesh_force: np.ndarray
    """Normal force, negative on the coast flanks [N], (samples, meshes)."""
    film_thickness: np.ndarray
    """[m], NaN without contact, (samples, meshes)."""
    lambda_ratio: np.ndarray
    """Specific film thickness [-], NaN without contact, (samples, meshes)."""
    boundary_friction: np.ndarray
    """Magnitude [N], (samples, meshes)."""
    viscous_friction: np.ndarray
    """Magnitude [N], (samples, meshes)."""
    power_loss: np.ndarray
    """Tooth friction [W], (samples, meshes)."""
    mesh_power: np.ndarray
    """Power that a mesh transmits in the frame of the carrier [W], (samples, meshes)."""
    bearing_loss: np.ndarray
    """All bearings, seals and grease [W], (samples,)."""
    churning_loss: np.ndarray
    """Oil churning [W], (samples,)."""
    energy: Energy
    mesh: dict[str, np.ndarray]
    """Statistics of the meshes over the evaluated time, (meshes,) each: see `mesh_statistics`."""
    mesh_efficiency: tuple[float, float]
    """Of the sun meshes and of the ring meshes: 1 - tooth friction/transmitted power."""
    stats: Stats

    @property
    def total_power_loss(self) -> np.ndarray:
        """Tooth friction of all meshes, bearings and churning [W], (samples,)."""
        total: np.ndarray = self.power_loss.sum(axis=1) + self.bearing_loss + self.churning_loss
        return total

    @property
    def mean_power_loss(self) -> float:
        """Tooth friction of all meshes, bearings and churning, over `duration` [W]."""
        return self.energy.loss / self.duration

    @property
    def efficiency(self) -> float:
        """1 - loss/put_in over `duration`; NaN if no machine drives."""
        if self.energy.put_in <= 0.0:
            return float("nan")
        return 1.0 - self.energy.loss / self.energy.put_in
