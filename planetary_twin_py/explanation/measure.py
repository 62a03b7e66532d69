"""Effect of each term, from simulations of the scene with and without it."""

from __future__ import annotations

from collections.abc import Callable
from statistics import median
from typing import Any, NamedTuple

from ..run.dynamics_choice import AUTO, DynamicsChoice
from ..run.result import Result
from ..scene import Scene
from ..simulation.choose_dynamics import choose_dynamics
from ..simulation.figures import Row, summary_of
from ..simulation.simulate import TOLERANCE, simulate
from .remarks import remarks
from .terms import Term, terms
from .tooth_entry import EntryPeaks, entry_peaks

REPEATS = 3  # runs for each timing


class Effect(NamedTuple):
    """A term, and the results of the scene without it."""

    term: Term
    without: Row  # see `summary_of`
    cost: float  # fraction of the computing time due to the term, median of paired runs


class Explanation(NamedTuple):
    """Results of a scene, and the effect of each of its terms."""

    figures: Row  # see `summary_of`
    effects: tuple[Effect, ...]
    entries: tuple[EntryPeaks, ...]  # peak loads of tooth pairs by their entry
    dynamics: DynamicsChoice  # every dynamics that the scene can have, against one another
    remarks: tuple[str, ...]  # warnings about the results

    def as_figures(self) -> dict[str, Any]:
        """The explanation for JSON."""
        return {
            "scene": self.figures,
            "terms": [
                {
                    "name": effect.term.name,
                    "law": effect.term.law,
                    "without": effect.without,
                    "cost": effect.cost,
                }
                for effect in self.effects
            ],
            "entry_of_teeth": [each.as_figures() for each in self.entries],
            "dynamics": self.dynamics.figures(),
            "remarks": self.remarks,
        }


def explain(
    scene: Scene, duration: float, progress: Callable[[str], None] = lambda _: None
) -> Explanation:
    """Simulate a scene as it is and without each of its terms.

    Args:
        scene: the scene; with dynamics: auto, the selected dynamics is explained.
        duration: simulated time of each run [s].
        progress: called with the name of each term before its runs.

    Returns:
        Results, effects and warnings.

    Raises:
        ValueError: the scene or the duration is invalid.
    """
    progress("dynamics")
    dynamics = choose_dynamics(scene)
    if scene.dynamics == AUTO:
        scene = dynamics.scene
    scene = scene.replace(sensors=())  # they change no result
    run = simulate(scene, duration)
    effects = []
    for term in terms(scene):
        progress(term.name)
        effects.append(_effect(scene, term, duration))
    progress("entry of teeth")
    entries = entry_peaks(scene, duration)
    warned = tuple(remarks(scene, run, TOLERANCE))
    return Explanation(summary_of(run), tuple(effects), entries, dynamics, warned)


def _effect(scene: Scene, term: Term, duration: float) -> Effect:
    changed = scene.replace(**term.without)
    pairs = [(simulate(scene, duration), simulate(changed, duration)) for _ in range(REPEATS)]
    cost = 1.0 - median(_time(without) / _time(with_) for with_, without in pairs)
    return Effect(term, summary_of(pairs[-1][1]), cost)


def _time(run: Result) -> float:
    return run.stats.wall_time
