"""What leaving a term out changes, measured by running the scene with and without it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from statistics import median
from typing import NamedTuple

import numpy as np

from ..result import Result
from ..scene import Scene
from ..simulation import simulate
from .terms import Term, terms

REPEATS = 3
SETTLING = 0.25  # share of a run that is not looked at


class Figures(NamedTuple):
    """What a run is judged by."""

    dte: float  # mean over all meshes, on whichever side [m]
    dte_vibration: float  # rms about the mean of each mesh, over all meshes [m]
    power_loss: float  # mean [W]
    wall_time: float  # median of several runs [s]


class Effect(NamedTuple):
    """A term with the figures of the scene without it."""

    term: Term
    without: Figures
    cost: float  # share of the run time that the term takes, median of paired runs


class Explanation(NamedTuple):
    """A scene and what each of its terms does."""

    figures: Figures
    effects: tuple[Effect, ...]


def explain(
    scene: Scene, duration: float, progress: Callable[[str], None] = lambda _: None
) -> Explanation:
    """Run `scene` for `duration` [s] as it is and without each of its terms."""
    whole = _figures(_runs(scene, duration))
    effects = []
    for term in terms(scene):
        progress(term.name)
        other = scene.replace(**term.without)
        pairs = [(_run(scene, duration), _run(other, duration)) for _ in range(REPEATS)]
        ratios = [without.stats.wall_time / with_.stats.wall_time for with_, without in pairs]
        without = _figures(without for _, without in pairs)
        effects.append(Effect(term, without, 1.0 - median(ratios)))
    return Explanation(whole, tuple(effects))


def _runs(scene: Scene, duration: float) -> Iterator[Result]:
    return (_run(scene, duration) for _ in range(REPEATS))


def _run(scene: Scene, duration: float) -> Result:
    return simulate(scene, duration, tolerance=1e-3)


def _figures(runs: Iterator[Result]) -> Figures:
    *others, last = runs
    late = last.time > SETTLING * last.time[-1]
    dte = last.dte[late]
    return Figures(
        dte=float(np.abs(dte.mean(axis=0)).mean()),
        dte_vibration=float(np.sqrt(dte.var(axis=0).mean())),
        power_loss=float(last.total_power_loss[late].mean()),
        wall_time=median(run.stats.wall_time for run in (*others, last)),
    )
