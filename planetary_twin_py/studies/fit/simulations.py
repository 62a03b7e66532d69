"""Simulations on all cores, each point only once."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from ...scene import Scene
from ..local import Threads
from .least_squares import Residuals
from .misfit import Yardstick
from .model import Model, Outcome
from .readings import Array


class Simulations:
    """What a model gives at points that are asked for; `hear` is told how many were simulated."""

    def __init__(
        self, model: Model, crew: Threads, hear: Callable[[int], None] = lambda count: None
    ) -> None:
        self._model, self._crew, self._hear = model, crew, hear
        self._known: dict[tuple[float, ...], Outcome | None] = {}

    @property
    def count(self) -> int:
        """Simulations so far."""
        return len(self._known)

    @property
    def scene(self) -> Scene:
        """The model, at what was recorded."""
        return self._model.stretch.scene

    def freeing(self, field: str) -> Simulations:
        """The same with a further free field, the last entry of a point."""
        wider = replace(self._model, free=(*self._model.free, field))
        return Simulations(wider, self._crew, self._hear)

    def at(self, points: Sequence[Array]) -> list[Outcome | None]:
        """The outcome at each point (p,)."""
        keys = [tuple(point.tolist()) for point in points]
        new = [key for key in dict.fromkeys(keys) if key not in self._known]
        for key, outcome in self._crew.do(lambda key: self._model(np.array(key)), new):
            self._known[key] = outcome
            self._hear(self.count)
        return [self._known[key] for key in keys]

    def apart(self, yardstick: Yardstick) -> Residuals:
        """Distances of the outcomes from the recording."""

        def residuals(points: Sequence[Array]) -> list[Array | None]:
            return [
                None if outcome is None else yardstick.apart(outcome.readings)
                for outcome in self.at(points)
            ]

        return residuals
