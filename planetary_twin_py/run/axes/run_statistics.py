"""Means and largest magnitudes of the motion of axes in a run, independent of the stored samples.

The integrator sums meshes, but not bearings. So a run with moving axes is sampled at a rate that
resolves its natural modes; samples between those that the caller keeps only enter the statistics.
"""

from __future__ import annotations

import math

import numpy as np

from ...model.bodies import BodyNames
from ...model.gearbox import Gearbox
from ...scene import Scene
from ..samples import Samples
from .load_shares import CycleShares
from .motion import flank_forces
from .statistics import AxesStatistics, TiltingStatistics

DISPLACEMENT, FORCE, THRUST, MOMENT, TILT = range(5)  # vectors of which magnitudes are summed


class AxesSums:
    """Sums over the samples of a run.

    Args:
        scene: scene of the run, whose axes move.
    """

    def __init__(self, scene: Scene) -> None:
        gearbox = Gearbox(scene)
        self._teeth, self._bodies = scene.gearset.tooth_numbers.sun, gearbox.body_names
        self._place = gearbox.mesh_names.place
        self._shares = CycleShares(scene.gearset.planets)
        self._count = 0
        self._moved, self._tilting = np.zeros(()), np.zeros(())
        self._sizes, self._peaks = np.zeros(()), np.zeros(())  # magnitudes: sum, and largest
        self._last: np.ndarray | None = None  # squares of the last two samples

    def add(self, samples: Samples) -> None:
        """Add samples.

        Args:
            samples: samples of a run whose axes move.
        """
        self._count += len(samples.moved)
        force = flank_forces(samples, self._place[: len(self._place) // 2])
        self._shares.add(self._mesh_cycles(samples), force[:, 0] - force[:, 1])
        self._moved = self._moved + samples.moved.sum(axis=0)
        self._tilting = self._tilting + samples.tilting.sum(axis=0)
        moved, tilting = samples.moved, samples.tilting
        vectors = (
            moved[:, :, :2],
            moved[:, :, 2:],
            tilting[:, :, 3:4],
            tilting[:, :, 4:],
            tilting[:, :, 1:3],
        )
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

    def _mesh_cycles(self, samples: Samples) -> np.ndarray:
        sun, carrier = (_turns(self._bodies, samples, body) for body in ("sun", "carrier"))
        return np.asarray(self._teeth * (sun - carrier))


def _turns(bodies: BodyNames, samples: Samples, name: str) -> np.ndarray:
    """Turns of a body at the samples, (samples,)."""
    body = bodies.names.index(name)
    ratio, place = bodies.ratio[body], bodies.place[body]
    turns = samples.turns[:, : len(ratio)] @ np.array([float(value) for value in ratio])
    held = place == samples.angle.shape[1]
    return np.asarray(turns if held else turns + samples.angle[:, place] / (2.0 * math.pi))


def _peaks(values: np.ndarray) -> np.ndarray:
    """Largest of values (samples, ...), and of the parabolas through three that have a summit."""
    largest: np.ndarray = values.max(axis=0, initial=0.0)
    before, here, after = values[:-2], values[1:-1], values[2:]
    bend = 2.0 * here - before - after
    summit = (here >= before) & (here >= after) & (bend > 0.0)
    rise = np.divide((after - before) ** 2, 8.0 * bend, out=np.zeros_like(here), where=summit)
    return np.maximum(largest, (here + rise).max(axis=0, initial=0.0, where=summit))
