"""A run whose axes move, sampled fast enough for statistics of its bearings."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..model.clock import samples_until
from ..model.planar_rows import CENTRAL
from ..run.axes.run_statistics import AxesSums
from ..run.axes.statistics import AxesStatistics
from ..run.commanded_run import DrivenRun
from ..run.samples import Samples
from ..scene import Scene

LEAST = 50_000.0  # [Hz] lowest rate at which axes are sampled


PER_PERIOD = 16.0  # samples of the fastest mode: peaks are then accurate to 1e-3


_MOST_AT_ONCE = 20_000  # samples in memory


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
