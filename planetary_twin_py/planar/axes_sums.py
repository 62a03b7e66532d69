"""Means and largest magnitudes of the motion of axes in a run, independent of the stored samples.

The integrator sums meshes, but not bearings. So a run with moving axes is sampled at a rate that
resolves its natural modes; samples between those that the caller keeps only enter the statistics.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from ..driven import DrivenRun
from ..dynamics.bodies import CENTRAL, BodyNames, body_names, mesh_names
from ..integrators.clock import samples_until
from ..integrators.interpolant import Samples
from ..scene import Scene
from .cycle_shares import CycleShares
from .motion import flank_forces

LEAST = 50_000.0  # [Hz] lowest rate at which axes are sampled
PER_PERIOD = 16.0  # samples of the fastest mode: peaks are then accurate to 1e-3
DISPLACEMENT, FORCE, THRUST, MOMENT, TILT = range(5)  # vectors of which magnitudes are summed
_MOST_AT_ONCE = 20_000  # samples in memory


class AxesStatistics(NamedTuple):
    """Statistics of all axes over a run, with the directions of `AxesMotion`.

    A load that stands still in the housing, such as weight, turns in the frame of the carrier, so
    it is not part of the mean vectors of sun, ring and carrier, but of the mean magnitudes.
    """

    displacement_mean: np.ndarray
    """Mean displacement [m], (bodies, 2)."""
    displacement_peak: np.ndarray
    """Largest displacement [m], (bodies,)."""
    bearing_force_mean: np.ndarray
    """Mean force on the bearing [N], (bodies, 2)."""
    bearing_force_peak: np.ndarray
    """Largest force on the bearing [N], (bodies,)."""
    tilting: TiltingStatistics | None
    """Statistics of axial motion and tilts; None where axes do not tilt."""
    displacement_magnitude: np.ndarray
    """Mean magnitude of the displacement [m], (bodies,)."""
    bearing_force_magnitude: np.ndarray
    """Mean magnitude of the force on the bearing [N], (bodies,)."""
    largest_load_share: np.ndarray | None
    """Largest share of each planet, of means over a mesh cycle, (planets,); None before a cycle is
    complete."""


class TiltingStatistics(NamedTuple):
    """Statistics of axial motion and tilts over a run."""

    axial_displacement_mean: np.ndarray
    """Mean axial displacement [m], (bodies,)."""
    tilt_mean: np.ndarray
    """Mean tilt about two directions [rad], (bodies, 2)."""
    axial_force_mean: np.ndarray
    """Mean thrust on the bearing [N], (bodies,)."""
    axial_force_peak: np.ndarray
    """Largest thrust on the bearing [N], (bodies,)."""
    tilting_moment_mean: np.ndarray
    """Mean moment on the bearing about two directions [N m], (bodies, 2)."""
    tilting_moment_peak: np.ndarray
    """Largest moment on the bearing [N m], (bodies,)."""
    tilt_magnitude: np.ndarray
    """Mean magnitude of the tilt [rad], (bodies,)."""
    tilting_moment_magnitude: np.ndarray
    """Mean magnitude of the moment on the bearing [N m], (bodies,)."""


class AxesSums:
    """Sums over the samples of a run.

    Args:
        scene: scene of the run, whose axes move.
    """

    def __init__(self, scene: Scene) -> None:
        self._teeth, self._bodies = scene.gearset.tooth_numbers.sun, body_names(scene)
        self._place = mesh_names(scene).place
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


def read_axes(
    run: DrivenRun, scene: Scene, span: tuple[float, float], sample_rate: float
) -> tuple[Samples, AxesStatistics]:
    """Advance a run whose axes move.

    Args:
        run: the run, which has reached the start of `span`.
        scene: its scene, whose axes move.
        span: start and end [s].
        sample_rate: sample rate of the returned samples [Hz].

    Returns:
        The samples, and the statistics over `span`.
    """
    begin, until = span
    needed = max(LEAST, PER_PERIOD * _fastest_mode(scene))
    decimation = max(1, math.ceil(needed / sample_rate))
    rate = decimation * sample_rate
    done, last = samples_until(begin, rate), samples_until(until, rate)
    sums, parts = AxesSums(scene), list[Samples]()
    while done < last:
        count = min(_MOST_AT_ONCE, last - done)
        # End between two samples, so that rounding cannot add or drop one.
        time = until if done + count == last else (done + count + 0.5) / rate
        samples = run.advance(time, done + 1, rate, count)
        sums.add(samples)
        first = (-done - 1) % decimation  # index of the first sample to keep
        parts.append(Samples(*(part[first::decimation].copy() for part in samples)))
        done += count
    return Samples(*map(np.concatenate, zip(*parts, strict=True))), sums.statistics()


def _fastest_mode(scene: Scene) -> float:
    """Frequency of the fastest natural mode [Hz], 0 where nothing vibrates."""
    if scene.quasi_static:
        return 0.0
    from ..modal.natural import natural_modes  # takes time to import

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
