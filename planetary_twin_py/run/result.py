"""Result of a run: samples, energy ledger and statistics."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..model.layout import LOAD_MACHINE, MOTOR, SECOND_MOTOR
from ..text.object_repr import brief
from .axes.motion import AxesMotion

if TYPE_CHECKING:
    from .dynamics_choice import DynamicsChoice


ROUNDING = 1e-9  # of the stored energy: work below it is due to rounding


@dataclass(frozen=True)
class Energy:
    """Energy ledger of a run [J]: input = output + stored + lost - stiffness_work - weight +
    residual."""

    machines: tuple[float, ...]
    """Work on the train by motor, load, and second motor of a differential [J], (machines,)."""
    kinetic: float
    """Increase of the kinetic energy [J]."""
    elastic: float
    """Increase of the elastic energy of meshes, couplings, bearings and tooth pairs before they
    slide, and of the potential energy of the weight [J]."""
    friction: float
    """Dissipated by tooth friction [J]."""
    damping: float
    """Dissipated by the damping of meshes and couplings [J]."""
    bearing: float
    """Dissipated by bearings, seals and grease [J]."""
    churning: float
    """Dissipated by oil churning [J]."""
    stiffness_work: float
    """Work due to the change of stiffness: of the meshes with the tooth pairs in contact, and of
    pairs that do not slide yet with their load [J]."""
    stored: float
    """Kinetic and elastic energy at the end [J]."""
    weight: float = 0.0
    """Work of the weight on displaced axes as they are turned with the carrier [J]."""
    both_ways: float = 0.0
    """Work that machines have both put in and taken out, as their power changed direction [J]."""

    @property
    def input(self) -> float:
        """Work of the motors [J]."""
        return self.machines[MOTOR] + sum(self.machines[SECOND_MOTOR:])

    @property
    def output(self) -> float:
        """Work done on the load [J]."""
        return -self.machines[LOAD_MACHINE]

    @property
    def driving_work(self) -> float:
        """Work that machines have put in while they drove [J]."""
        return sum(max(work, 0.0) for work in self.machines) + self.both_ways

    @property
    def put_in(self) -> float:
        """Deprecated name of `driving_work` [J]."""
        return self.driving_work

    @property
    def driven(self) -> bool:
        """Whether work passes through the train, unlike at standstill.

        What is only stored, as where a set-point at rest winds up a shaft, does not pass.
        """
        return self.driving_work - max(self.kinetic + self.elastic, 0.0) > ROUNDING * self.stored

    @property
    def residual(self) -> float:
        """Residual of the balance, an error of the integration [J]."""
        lost = self.loss + self.damping - self.stiffness_work - self.weight
        return self.input - self.output - self.kinetic - self.elastic - lost

    @property
    def loss(self) -> float:
        """Dissipated by tooth friction, bearings, seals and churning [J]."""
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
    """Computed steps whose error exceeded the tolerance."""
    evaluations: int
    """Evaluations of the equations of motion."""
    pair_events: int
    """Starts and ends of the engagement and disengagement of tooth pairs."""
    flank_events: int
    """Engagements and separations of flanks."""
    reversals: int
    """Steps in which vibration may have stopped or reversed a gear relative to the carrier, or
    slowed a creeping one by a fifth."""
    both_flanks: int
    """Steps in which both flanks of a mesh touch; the model has a force on one of them only."""
    wall_time: float
    """Wall time of the integration [s]."""
    real_time_factor: float
    """Simulated time over wall time."""


@dataclass(frozen=True)
class Result:
    """Samples, energy ledger and statistics of a run."""

    duration: float
    """Time that the energy ledger covers [s]: from the end of the step in which settling ends to
    the end of the last step."""
    time: np.ndarray
    """Sample times [s], (samples,)."""
    bodies: tuple[str, ...]
    """Names of the bodies, in the order of arrays over bodies."""
    meshes: tuple[str, ...]
    """Names of the meshes, in the order of arrays over meshes."""
    angle: np.ndarray
    """Absolute angle, positive counter-clockwise [rad], (samples, bodies)."""
    speed: np.ndarray
    """Absolute speed, positive counter-clockwise [rad/s], (samples, bodies)."""
    mean_speed: np.ndarray
    """Mean speed over the time of the samples [rad/s], (bodies,)."""
    dte: np.ndarray
    """Dynamic transmission error along the line of action [m], (samples, meshes)."""
    mesh_force: np.ndarray
    """Normal force, negative on the coast flanks [N], (samples, meshes)."""
    film_thickness: np.ndarray
    """Film thickness [m], NaN without contact, (samples, meshes)."""
    lambda_ratio: np.ndarray
    """Specific film thickness [-], NaN without contact, (samples, meshes)."""
    boundary_friction: np.ndarray
    """Magnitude of the boundary friction [N], (samples, meshes)."""
    viscous_friction: np.ndarray
    """Magnitude of the viscous friction [N], (samples, meshes)."""
    power_loss: np.ndarray
    """Power loss of tooth friction [W], (samples, meshes)."""
    mesh_power: np.ndarray
    """Power transmitted by a mesh in the frame of the carrier [W], (samples, meshes)."""
    bearing_loss: np.ndarray
    """Power loss of all bearings, seals and grease [W], (samples,)."""
    churning_loss: np.ndarray
    """Power loss of oil churning [W], (samples,)."""
    energy: Energy
    """Energy ledger over `duration`."""
    mesh: dict[str, np.ndarray]
    """Statistics of the meshes over the time of the samples, (meshes,) each, by name."""
    mesh_efficiency: tuple[float, float]
    """Of the sun-planet and of the planet-ring meshes: 1 - friction loss/transmitted power."""
    stats: Stats
    """Statistics of the integration."""
    start_warning: str = ""
    """Why the start of the run is no equilibrium, "" if it is one."""
    choice: DynamicsChoice | None = None
    """Selection by dynamics: auto, with reasons; None if the scene gives its dynamics."""
    axes: AxesMotion | None = None
    """Motion of the axes and forces on their bearings; None where the axes are held."""

    @property
    def total_power_loss(self) -> np.ndarray:
        """Power loss of tooth friction, bearings, seals and churning [W], (samples,)."""
        total: np.ndarray = self.power_loss.sum(axis=1) + self.bearing_loss + self.churning_loss
        return total

    @property
    def mean_power_loss(self) -> float:
        """Mean power loss of tooth friction, bearings, seals and churning over `duration` [W]."""
        return self.energy.loss / self.duration

    @property
    def efficiency(self) -> float:
        """1 - loss/driving work over `duration`; NaN unless `Energy.driven`, as at standstill.

        Work counts where it is put in, at any shaft, so a reversal of the power does not cancel it.
        """
        if not self.energy.driven:
            return float("nan")
        return 1.0 - self.energy.loss / self.energy.driving_work

    def __repr__(self) -> str:
        """One line."""
        samples, meshes = f"{len(self.time)} samples", f"{len(self.meshes)} meshes"
        efficiency = f"efficiency {self.efficiency:.4g}"
        return brief(self, f"{self.duration:g} s", samples, meshes, efficiency)
