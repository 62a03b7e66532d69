"""Results of a run with moving axes: displacements, bearing forces, loads of both flanks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...model.planar_rows import CENTRAL
from ..samples import Waves
from .load_shares import CycleShares
from .statistics import AxesStatistics
from .tilting import TiltingMotion, tilting_motion


@dataclass(frozen=True)
class AxesMotion:
    """Motion of the axes in a run, and loads of their bearings and of both flanks of the teeth.

    Displacements and forces of sun, ring and carrier are x and y in the frame that turns with the
    carrier; x is the direction of angle 0 of `gearset.planet_angles`. Those of planets are radial
    (outwards) and tangential (counter-clockwise).
    """

    bodies: tuple[str, ...]
    """"sun", "ring", "carrier", "planet_1" and so on, in the order of arrays over bodies."""
    displacement: np.ndarray
    """Displacement of each axis [m], (samples, bodies, 2).

    Of sun, ring and carrier from the axis of the bearing, offset by `errors.*_offset`; of planets
    from the nominal place, without the error of the pin, in the frame that turns with the carrier:
    the deflection of a pin is this less the error of the pin and the displacement of the carrier.
    """
    bearing_force: np.ndarray
    """Force of each body on its bearing [N], (samples, bodies, 2)."""
    orbit: np.ndarray
    """Displacement of sun, ring and carrier, x and y in the housing [m], (samples, 3, 2)."""
    flank_force: np.ndarray
    """Force of the drive flanks, then of the coast flanks of each mesh [N],
    (samples, 2, meshes)."""
    mean_load_share: np.ndarray
    """Mean torque that each planet takes from the sun over the mean of all planets, (planets,); an
    integral over the time of the samples, NaN where the mean of all is zero."""
    tilting: TiltingMotion | None = None
    """Axial motion and tilts, thrust and moments on bearings; None where axes do not tilt."""
    statistics: AxesStatistics | None = None
    """Means and peaks over a run, independent of its samples; None for a window of a twin."""
    mesh_cycles: np.ndarray | None = None
    """Mesh cycles at the samples of a window, from any start, at its mean speed, (samples,)."""

    @property
    def load_share(self) -> np.ndarray:
        """Torque that each planet takes from the sun over the mean of all planets, NaN where that
        is zero, (samples, planets)."""
        return _shares(self._load)

    @property
    def largest_load_share(self) -> np.ndarray:
        """Largest share of each planet, of means over a mesh cycle, (planets,); `mean_load_share`
        before a cycle is complete."""
        if self.statistics is not None:
            found = self.statistics.largest_load_share
        elif self.mesh_cycles is not None:
            shares = CycleShares(len(self.mean_load_share))
            shares.add(self.mesh_cycles, self._load)
            found = shares.largest()
        else:
            found = None
        return self.mean_load_share if found is None else found

    @property
    def load_sharing_factor(self) -> float:
        """Load sharing factor K_gamma: the largest mean share of a planet over a mesh cycle, as of
        `load_sharing`."""
        return float(self.largest_load_share.max())

    @property
    def _load(self) -> np.ndarray:
        """Net forces of the sun meshes [N], (samples, planets)."""
        sun_meshes = slice(len(self.mean_load_share))
        return np.asarray(self.flank_force[:, 0, sun_meshes] - self.flank_force[:, 1, sun_meshes])


def axes_of_waves(
    waves: Waves, planets: int, mesh_force: np.ndarray, mesh_frequency: float
) -> AxesMotion | None:
    """Compute the motion of the axes from the samples of a window or a run.

    Args:
        waves: samples of the window.
        planets: number of planets.
        mesh_force: mean force of each mesh over the window [N], (meshes,).
        mesh_frequency: mean mesh frequency of the window [Hz].

    Returns:
        Displacements, forces and shares; None if the axes are held.
    """
    axes = waves.axes
    if axes is None:
        return None
    names, rows = axes_names(planets), len(waves.time)
    return AxesMotion(
        names,
        axes.displacement.reshape(rows, len(names), 2),
        axes.bearing_force.reshape(rows, len(names), 2),
        axes.orbit.reshape(rows, len(CENTRAL), 2),
        axes.flank_force.reshape(rows, 2, len(mesh_force)),
        _shares(mesh_force[:planets]),
        tilting_motion(axes.tilting.reshape(rows, len(names), axes.tilting.shape[1] // len(names))),
        mesh_cycles=mesh_frequency * waves.time,
    )


def axes_names(planets: int) -> tuple[str, ...]:
    """Names of the bodies in the order of arrays over bearings."""
    return (*CENTRAL, *(f"planet_{i + 1}" for i in range(planets)))


def _shares(force: np.ndarray) -> np.ndarray:
    """Forces of the sun meshes over their mean, NaN where that is zero, (..., planets)."""
    mean = force.mean(axis=-1, keepdims=True)
    return np.asarray(np.divide(force, mean, out=np.full_like(force, np.nan), where=mean != 0.0))
