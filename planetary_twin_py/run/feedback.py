"""Feedback gain of a run at its present temperatures, from quasi-static running.

Heat is computed with all parts colder and warmer than now by half a step; each source then has its
derivative with respect to its own temperature. See `run.steady_temperatures` for the gain.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from contextlib import suppress

import numpy as np
from numpy.typing import NDArray

from ..scene import OperatingPoint, Scene
from ..scene.thermal import NODES
from .conduction import Conduction, gain_of
from .heat_curve import TOLERANCE, steady_scene
from .quasi_static.engine import QuasiStaticEngine

Array = NDArray[np.float64]

STEP = 5.0  # [K] of the difference quotient: losses have an error of 1e-4
MOVED = 0.5  # [K] up to which a gain is kept ...
SAME = 0.01  # ... and share of a speed or a torque
LOAD = ("input_speed", "second_input_speed", "input_torque")


class FeedbackGain:
    """Computes the gain again where temperatures or loads have changed.

    Args:
        scene: the scene, with the section `thermal`.
    """

    def __init__(self, scene: Scene) -> None:
        self._conduction = Conduction(scene)
        assert scene.thermal is not None
        anywhere = scene.thermal.model_copy(update={"start": "ambient"})
        self._scene = steady_scene(scene.model_copy(update={"thermal": anywhere}))
        self._engine: QuasiStaticEngine | None = None
        with suppress(ValueError):  # there may be an equilibrium at another point
            self._engine = QuasiStaticEngine(self._scene, TOLERANCE)
        self.begin()

    def begin(self) -> None:
        """Begin another run."""
        self._point: OperatingPoint | None = None
        self._at, self._gain = np.full(len(NODES), np.nan), math.nan

    def __call__(self, temperatures: Mapping[str, float], point: OperatingPoint) -> float:
        """The gain.

        Args:
            temperatures: by part and of the ambient air [K].
            point: operating point.

        Returns:
            The gain [-]; NaN at rest, or if there is no equilibrium.
        """
        now = np.array([temperatures[node] for node in NODES])
        if not (self._is_near(point) and (np.abs(now - self._at) < MOVED).all()):
            self._point, self._at = point, now
            self._conduction.ambient = temperatures["ambient"]
            self._gain = self._computed(now, point)
        return self._gain

    def _is_near(self, point: OperatingPoint) -> bool:
        """Whether an operating point has about the load of the last gain, and equals it else."""
        if self._point is None:
            return False
        pairs = [(value, getattr(self._point, name), name) for name, value in point]
        return all(
            abs(now - last) <= SAME * abs(last) if name in LOAD else now == last
            for now, last, name in pairs
        )

    def _computed(self, now: Array, point: OperatingPoint) -> float:
        if point.input_speed == point.second_input_speed == 0.0:
            return math.nan
        try:
            cold, warm = (self._heat(now + offset, point) for offset in (-0.5 * STEP, 0.5 * STEP))
        except ValueError:  # no equilibrium
            return math.nan
        _, (leaving,) = self._conduction.outflow(now[None])
        return gain_of(leaving, self._conduction.heating((warm - cold) / STEP))

    def _heat(self, temperatures: Array, point: OperatingPoint) -> Array:
        """Mean heat by source at temperatures [W], (sources,)."""
        if self._engine is None:
            there = self._scene.model_copy(update={"operating_point": point})
            self._engine = QuasiStaticEngine(there, TOLERANCE)
        assert self._engine.warming is not None
        self._engine.warming.network.temperature = temperatures
        self._engine.start_again(point.model_copy(update={"torque_ripple": 0.0}))
        return self._engine.mean_heat()
