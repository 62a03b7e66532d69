"""Result of a run: samples, energy ledger and statistics."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ..durability.damage import Damage
from ..sensors.sensed import Readings
from ..text.object_repr import brief
from .axes.motion import AxesMotion
from .energy import Energy, efficiency

if TYPE_CHECKING:
    from .dynamics_choice import DynamicsChoice


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
    """Time that the samples, the energy ledger and the statistics cover [s]."""
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
    damage: Damage | None = None
    """Damage of the parts over `duration`; None if the scene has no section `durability`."""
    temperatures: Mapping[str, float] = field(default_factory=dict)
    """Temperatures at the end [K]: oil, sun, planets, ring, housing, ambient; empty unless they are
    states (`thermal`)."""
    heat: Mapping[str, float] = field(default_factory=dict)
    """Mean heat by source over `duration` [W]; empty unless temperatures are states."""
    sensors: Mapping[str, Readings] = field(default_factory=dict)
    """Readings of the sensors in the time of the samples, by name; the last ones of each wait for
    its filters."""

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
        energy = self.energy
        return efficiency(energy.loss, energy.driving_work, energy.gained, energy.stored)

    def __repr__(self) -> str:
        """One line."""
        samples, meshes = f"{len(self.time)} samples", f"{len(self.meshes)} meshes"
        efficiency = f"efficiency {self.efficiency:.4g}"
        return brief(self, f"{self.duration:g} s", samples, meshes, efficiency)
