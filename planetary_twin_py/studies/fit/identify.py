"""Parameters of a gearbox from a recording of it, from reading the file to what is not told."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ..local import Threads
from .estimate import Estimate, conclude
from .lacking import Lacking, find_lacking
from .least_squares import Minimum, explained, minimise, with_magnitudes
from .least_squares import search as find_least
from .misfit import Yardstick, measure_noise
from .model import Model, Outcome, read_all
from .parameter import Parameter, read_parameters
from .readings import HARMONICS, USUAL, Array, Readings, check_observables, recorded
from .simulations import Simulations
from .stretch import Stretch, read_stretch

ROUNDS = 4  # of weighing anew with what is left at the minimum
SETTLED = 0.05  # change of a noise that needs no other round


class Search(NamedTuple):
    """What is looked for, and in what."""

    free: Sequence[str]
    """Fields of the scene, by their dotted names."""
    observe: Sequence[str] = USUAL
    """See `readings.OBSERVABLES`."""
    start: Mapping[str, Any] = {}
    """Where the search begins, where that is not the recorded value."""
    noise: Mapping[str, float] = {}
    """Standard deviation of a reading of an observable, where it is known."""
    confidence: float = 0.95


@dataclass(frozen=True)
class Identified:
    """What a recording tells of its parameters."""

    parameters: tuple[Parameter, ...]
    estimate: Estimate
    stretch: Stretch
    contact_fraction: float
    """Of the mesh where it is smallest, in the simulation at the estimate."""
    yardstick: Yardstick
    confidence: float
    """Of the intervals."""
    sum: float
    """Of squares at the estimate."""
    lacking: Lacking | None
    """What the model leaves out and would explain what it misses; None if nothing does."""
    simulations: int
    wall_time: float
    """[s]"""


def identify(
    path: str | Path,
    search: Search,
    namespace: str | None = None,
    begin: float | None = None,
    end: float | None = None,
    crew: Threads | None = None,
    hear: Callable[[int], None] = lambda simulations: None,
) -> Identified:
    """Estimate what is free in `search` from the recording at `path`.

    Args:
        path: an .mcap file or the folder of one.
        search: what is looked for.
        namespace: which gearbox, if the recording holds several.
        begin, end: stretch [s] of its longest run; None: see `read_stretch`.
        crew: who simulates; all cores unless given.
        hear: is told how many simulations are done.

    Raises:
        ValueError: a name or a value cannot be, or the recording holds no such stretch.
        ArithmeticError: the stretch cannot be simulated.
    """
    began = time.perf_counter()
    _check(search)
    stretch = read_stretch(Path(path), namespace, begin, end, HARMONICS in search.observe)
    parameters = read_parameters(stretch.scene, search.free, search.start)
    data = _data(search, stretch)
    model = Model(stretch, tuple(search.free), tuple(search.observe))
    runs = Simulations(model, crew or Threads(), hear)

    def weigh(values: Array) -> Yardstick:
        return measure_noise(data, _known(runs, values).readings, stretch.tolerance, search.noise)

    yardstick = weigh(np.array([p.start for p in parameters]))
    if yardstick.count < len(parameters):
        raise ValueError(
            f"free = {', '.join(search.free)}: {yardstick.count} readings cannot tell "
            f"{len(parameters)} parameters; observe more, or more operating points"
        )
    parameters = with_magnitudes(runs.apart(yardstick), parameters)
    minimum = find_least(runs.apart(yardstick), parameters)
    for _ in range(ROUNDS):
        closer = weigh(minimum.values)
        if closer.near(yardstick, SETTLED):
            break
        yardstick = closer
        minimum = minimise(runs.apart(yardstick), parameters, minimum.values)
        if not explained(minimum):
            minimum = min(
                minimum, find_least(runs.apart(yardstick), parameters), key=lambda m: m.sum
            )
    found = conclude(
        runs.apart(yardstick), parameters, minimum, yardstick.freedom, search.confidence
    )
    return Identified(
        parameters=parameters,
        estimate=found,
        stretch=stretch,
        contact_fraction=_known(runs, minimum.values).contact_fraction,
        yardstick=yardstick,
        confidence=search.confidence,
        sum=minimum.sum,
        lacking=_lacking(runs, yardstick, parameters, minimum, found),
        simulations=runs.count,
        wall_time=time.perf_counter() - began,
    )


def _check(search: Search) -> None:
    check_observables(search.observe)
    for name, value in search.noise.items():
        if name not in search.observe:
            raise ValueError(f"noise = {name}: is not observed")
        if not 0.0 < value < math.inf:
            raise ValueError(f"noise of {name} = {value!r}: must be above 0")
    if not 0.0 < search.confidence < 1.0:
        raise ValueError(f"confidence = {search.confidence!r}: must be between 0 and 1")


def _data(search: Search, stretch: Stretch) -> tuple[Readings, ...]:
    data = read_all(search.observe, recorded(stretch), stretch)
    for readings in data:
        if not np.all(np.isfinite(readings.values)):
            raise ValueError(f"observe = {readings.name}: is no number somewhere in this stretch")
    return data


def _lacking(
    runs: Simulations,
    yardstick: Yardstick,
    parameters: Sequence[Parameter],
    minimum: Minimum,
    found: Estimate,
) -> Lacking | None:
    """What the model leaves out, where noise does not explain what is left or a range holds it."""
    enough = len(minimum.residuals) > len(parameters)
    if not enough or (explained(minimum) and not any(found.at_bound)):
        return None

    def trial(field: str, value: float) -> Array | None:
        wider = runs.freeing(field)
        return wider.apart(yardstick)([np.append(minimum.values, value)])[0]

    return find_lacking(runs.scene, parameters, minimum, trial)


def _known(runs: Simulations, values: Array) -> Outcome:
    outcome = runs.at([values])[0]
    if outcome is None:
        raise ArithmeticError(f"the stretch cannot be simulated with what is free at {values}")
    return outcome
