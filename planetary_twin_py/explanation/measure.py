"""What leaving a term out changes, measured by running the scene with and without it."""

from __future__ import annotations

from collections.abc import Callable
from statistics import median
from typing import NamedTuple

from ..result import Result
from ..scene import Scene
from ..simulation import TOLERANCE, simulate
from ..studies.measures import Glance, glance
from .remarks import remarks
from .terms import Term, terms

REPEATS = 3  # of every run, to time it


class Effect(NamedTuple):
    """A term with the figures of the scene without it."""

    term: Term
    without: Glance
    cost: float  # share of the run time that the term takes, median of paired runs


class Explanation(NamedTuple):
    """A scene and what each of its terms does."""

    figures: Glance
    effects: tuple[Effect, ...]
    remarks: tuple[str, ...]  # what whoever reads the figures must know


def explain(
    scene: Scene, duration: float, progress: Callable[[str], None] = lambda _: None
) -> Explanation:
    """Run `scene` for `duration` [s] as it is and without each of its terms, as `simulate` does."""
    whole = simulate(scene, duration)
    effects = []
    for term in terms(scene):
        progress(term.name)
        effects.append(_effect(scene, term, duration))
    return Explanation(glance(whole), tuple(effects), tuple(remarks(scene, whole, TOLERANCE)))


def _effect(scene: Scene, term: Term, duration: float) -> Effect:
    other = scene.replace(**term.without)
    pairs = [(simulate(scene, duration), simulate(other, duration)) for _ in range(REPEATS)]
    cost = 1.0 - median(_time(without) / _time(with_) for with_, without in pairs)
    return Effect(term, glance(pairs[-1][1]), cost)


def _time(run: Result) -> float:
    return run.stats.wall_time
