"""Means and largest magnitudes of the motion of axes in a run, independent of the stored samples.

The integrator sums meshes, but not bearings. So a run with moving axes is sampled at a rate that
resolves its natural modes; samples between those that the caller keeps only enter the statistics.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ...model.gearbox import Gearbox
from ...model.planar_rows import CENTRAL
from ...scene import Scene
from ..samples import AxesWaves, BodyWaves
from .load_shares import CycleShares
from .motion import axes_names
from .statistics import AxesStatistics, TiltingStatistics

DISPLACEMENT, FORCE, THRUST, MOMENT, TILT = range(5)  # vectors of which magnitudes are summed


LEAST = 50_000.0  # [Hz] lowest rate at which axes are sampled
PER_PERIOD = 16.0  # samples of the fastest mode: peaks are then accurate to 1e-3
MOST_AT_ONCE = 20_000  # samples in memory


class AxesSums:
    """Sums over the samples of a run.

    Args:
        gearbox: of the run, whose axes move.
    """

    def __init__(self, gearbox: Gearbox) -> None:
        bodies, self._planets = gearbox.body_names.names, gearbox.scene.gearset.planets
        self._sun, self._carrier = bodies.index("sun"), bodies.index("carrier")
        self._teeth = gearbox.scene.gearset.tooth_numbers.sun
        self._axes, self._shares = len(axes_names(self._planets)), CycleShares(self._planets)
        self._count = 0
        self._moved, self._tilting = np.zeros(()), np.zeros(())
        self._sizes, self._peaks = np.zeros(()), np.zeros(())  # magnitudes: sum, and largest
        self._last: np.ndarray | None = None  # squares of the last two samples

    def add(self, bodies: BodyWaves, axes: AxesWaves) -> None:
        """Add samples.

        Args:
            bodies: samples of the bodies of a run.
            axes: samples of its axes, which move.
        """
        rows = len(bodies.angle)
        if not rows:
            return
        self._count += rows
        drive, coast = axes.flank_force.reshape(rows, 2, -1)[:, :, : self._planets].swapaxes(0, 1)
        turned = bodies.angle[:, self._sun] - bodies.angle[:, self._carrier]
        self._shares.add(self._teeth * turned / (2.0 * math.pi), drive - coast)
        displacement, force, tilting = (
            values.reshape(rows, self._axes, -1)
            for values in (axes.displacement, axes.bearing_force, axes.tilting)
        )
        moved = np.concatenate([displacement, force], axis=2)
        self._moved = self._moved + moved.sum(axis=0)
        self._tilting = self._tilting + tilting.sum(axis=0)
        vectors = (displacement, force, tilting[:, :, 3:4], tilting[:, :, 4:], tilting[:, :, 1:3])
        squares = np.stack([(part * part).sum(axis=2) for part in vectors], axis=1)
        self._sizes = self._sizes + np.sqrt(squares).sum(axis=0)
        joined = squares if self._last is None else np.concatenate([self._last, squares])
        self._last = joined[-2:]
        self._peaks = np.maximum(self._peaks, np.sqrt(_peaks(joined)))

    def statistics(self) -> AxesStatistics:
        """Statistics of all samples added, of which there is at least one."""
        moved, tilted = self._moved / self._count, self._tilting / self._count
        means = self._sizes / self._count
        tilting = None
        if tilted.shape[1]:
            tilting = TiltingStatistics(
                axial_displacement_mean=tilted[:, 0],
                tilt_mean=tilted[:, 1:3],
                axial_force_mean=tilted[:, 3],
                axial_force_peak=self._peaks[THRUST],
                tilting_moment_mean=tilted[:, 4:],
                tilting_moment_peak=self._peaks[MOMENT],
                tilt_magnitude=means[TILT],
                tilting_moment_magnitude=means[MOMENT],
            )
        return AxesStatistics(
            displacement_mean=moved[:, :2],
            displacement_peak=self._peaks[DISPLACEMENT],
            bearing_force_mean=moved[:, 2:],
            bearing_force_peak=self._peaks[FORCE],
            tilting=tilting,
            displacement_magnitude=means[DISPLACEMENT],
            bearing_force_magnitude=means[FORCE],
            largest_load_share=self._shares.largest(),
        )


def decimation(scene: Scene, sample_rate: float) -> int:
    """Number of samples for statistics per sample that the caller keeps.

    Args:
        scene: scene of the run, whose axes move.
        sample_rate: of the samples that are kept [Hz].

    Returns:
        The number, at least 1.
    """
    needed = max(LEAST, PER_PERIOD * _fastest_mode(scene))
    return max(1, math.ceil(needed / sample_rate))


def _peaks(values: np.ndarray) -> np.ndarray:
    """Largest of values (samples, ...), and of the parabolas through three that have a summit."""
    largest: np.ndarray = values.max(axis=0, initial=0.0)
    before, here, after = values[:-2], values[1:-1], values[2:]
    bend = 2.0 * here - before - after
    summit = (here >= before) & (here >= after) & (bend > 0.0)
    rise = np.divide((after - before) ** 2, 8.0 * bend, out=np.zeros_like(here), where=summit)
    return np.maximum(largest, (here + rise).max(axis=0, initial=0.0, where=summit))


def _fastest_mode(scene: Scene) -> float:
    """Frequency of the fastest natural mode [Hz], 0 where nothing vibrates."""
    if scene.quasi_static:
        return 0.0
    from ...modal.natural import natural_modes  # takes time to import

    modes = natural_modes(_always_touching(scene), model=scene.dynamics, stiffness="mean")
    return float(modes.frequencies.max())


def _always_touching(scene: Scene) -> Scene:
    """The scene with linear bearings and flanks that always touch, as stiff as they become."""
    clearances = {
        f"supports.{body}.clearance": 0.0
        for body in (*CENTRAL, "planet")
        if getattr(scene.supports, body).rolling is None
    }
    factors = {name: getattr(scene.errors, name) for name in ("planet_stiffness", "pin_stiffness")}
    flat: dict[str, Any] = {
        "mesh.runout": {},
        "mesh.sun_planet_error": {},
        "mesh.planet_ring_error": {},
    }
    return scene.replace(**clearances, **flat, **{"errors": factors, "supports.gravity": 0.0})
