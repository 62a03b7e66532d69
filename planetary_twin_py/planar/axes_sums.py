"""Means and largest magnitudes of what axes show in a run, whatever samples of it are kept.

Bearings have no sums in the integrator, as meshes have, so a run with moving axes is read at a rate
that resolves its natural modes, and the samples between those that are kept are only summed up.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..driven import DrivenRun
from ..integrators.clock import samples_until
from ..integrators.interpolant import Samples
from ..scene import Scene

LEAST = 50_000.0  # [Hz] rate at which axes are read
PER_PERIOD = 16.0  # samples of the fastest mode: peaks are then accurate to 1e-3
_MOST_AT_ONCE = 20_000  # samples in memory


class AxesStatistics(NamedTuple):
    """Statistics of all axes over a run, with the directions of `AxesMotion`."""

    displacement_mean: np.ndarray
    """Mean displacement [m], (bodies, 2)."""
    displacement_peak: np.ndarray
    """Largest magnitude [m], (bodies,)."""
    bearing_force_mean: np.ndarray
    """Mean force on the bearing [N], (bodies, 2)."""
    bearing_force_peak: np.ndarray
    """Largest magnitude [N], (bodies,)."""
    tilting: TiltingStatistics | None
    """None where axes do not tilt."""


class TiltingStatistics(NamedTuple):
    """Statistics of axial motion and tilts over a run."""

    axial_displacement_mean: np.ndarray
    """[m], (bodies,)."""
    tilt_mean: np.ndarray
    """About two directions [rad], (bodies, 2)."""
    axial_force_mean: np.ndarray
    """Thrust on the bearing [N], (bodies,)."""
    axial_force_peak: np.ndarray
    """Largest magnitude [N], (bodies,)."""
    tilting_moment_mean: np.ndarray
    """About two directions [N m], (bodies, 2)."""
    tilting_moment_peak: np.ndarray
    """Largest magnitude [N m], (bodies,)."""


class AxesSums:
    """Sums over the samples of a run."""

    def __init__(self) -> None:
        self._count = 0
        self._moved, self._lean = np.zeros(()), np.zeros(())
        self._peaks = np.zeros(())
        self._last: np.ndarray | None = None  # squares of the last two samples

    def add(self, samples: Samples) -> None:
        """Add samples.

        Args:
            samples: of a run whose axes move.
        """
        self._count += len(samples.moved)
        self._moved = self._moved + samples.moved.sum(axis=0)
        self._lean = self._lean + samples.lean.sum(axis=0)
        moved, lean = samples.moved, samples.lean
        vectors = moved[:, :, :2], moved[:, :, 2:], lean[:, :, 3:4], lean[:, :, 4:]
        squares = np.stack([(part * part).sum(axis=2) for part in vectors], axis=1)
        joined = squares if self._last is None else np.concatenate([self._last, squares])
        self._last = joined[-2:]
        self._peaks = np.maximum(self._peaks, np.sqrt(_peaks(joined)))

    def statistics(self) -> AxesStatistics:
        """Statistics of all samples added, of which there is at least one."""
        moved, lean = self._moved / self._count, self._lean / self._count
        displaced, force, thrust, moment = self._peaks
        tilting = None
        if lean.shape[1]:
            tilting = TiltingStatistics(
                lean[:, 0], lean[:, 1:3], lean[:, 3], thrust, lean[:, 4:], moment
            )
        return AxesStatistics(moved[:, :2], displaced, moved[:, 2:], force, tilting)


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
        run: the run, at the begin of `span`.
        scene: its scene, whose axes move.
        span: begin and end [s].
        sample_rate: of the samples that are kept [Hz].

    Returns:
        The samples, and statistics of the time of `span`.
    """
    begin, until = span
    needed = max(LEAST, PER_PERIOD * _fastest(scene))
    finer = max(1, math.ceil(needed / sample_rate))
    rate = finer * sample_rate
    done, last = samples_until(begin, rate), samples_until(until, rate)
    sums, parts = AxesSums(), list[Samples]()
    while done < last:
        count = min(_MOST_AT_ONCE, last - done)
        # Between two samples, where rounding decides nothing.
        time = until if done + count == last else (done + count + 0.5) / rate
        found = run.advance(time, done + 1, rate, count)
        sums.add(found)
        first = (-done - 1) % finer  # of those that are kept
        parts.append(Samples(*(part[first::finer].copy() for part in found)))
        done += count
    return Samples(*map(np.concatenate, zip(*parts, strict=True))), sums.statistics()


def _fastest(scene: Scene) -> float:
    """Frequency of the fastest natural mode [Hz], 0 where nothing vibrates."""
    if scene.quasi_static:
        return 0.0
    from ..modal.natural import natural_modes  # takes time to import

    modes = natural_modes(scene, model=scene.dynamics, stiffness="mean")
    return float(modes.frequencies.max())
