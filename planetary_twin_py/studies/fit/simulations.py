"""Simulations in parallel, with the results cached."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from ...scene import Scene
from ...simulation.threads import Threads
from .least_squares import Residuals
from .misfit import WeightedReadings
from .model import Model, ModelOutput
from .readings import Array


class Simulations:
    """Cached outputs of a model; `report` is called with the number of simulations so far."""

    def __init__(
        self, model: Model, threads: Threads, report: Callable[[int], None] = lambda count: None
    ) -> None:
        self._model, self.threads, self._report = model, threads, report
        self._known: dict[tuple[float, ...], ModelOutput | None] = {}

    @property
    def count(self) -> int:
        """Number of simulations so far."""
        return len(self._known)

    @property
    def scene(self) -> Scene:
        """The scene with its recorded values."""
        return self._model.excerpt.scene

    def freeing(self, field: str) -> Simulations:
        """Simulations with `field` as a further free parameter, the last entry of a point."""
        wider = replace(self._model, free=(*self._model.free, field))
        return Simulations(wider, self.threads, self._report)

    def at(self, points: Sequence[Array]) -> list[ModelOutput | None]:
        """The output at each point, values of the free parameters in SI, (p,) each."""
        keys = [tuple(point.tolist()) for point in points]
        new = [key for key in dict.fromkeys(keys) if key not in self._known]
        for key, output in self.threads.run(lambda key: self._model(np.array(key)), new):
            self._known[key] = output
            self._report(self.count)
        return [self._known[key] for key in keys]

    def residuals(self, weighted: WeightedReadings) -> Residuals:
        """Function that returns the residuals at several points."""

        def residuals(points: Sequence[Array]) -> list[Array | None]:
            return [
                None if output is None else weighted.residuals(output.readings)
                for output in self.at(points)
            ]

        return residuals
