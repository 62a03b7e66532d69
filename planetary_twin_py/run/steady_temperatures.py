"""Steady temperatures of a scene: all states, their stability, feedback gain and time constants.

With losses P(T) and conductances K, K T = P(T) + what comes from outside. Small changes follow
C dT'/dt = (dP/dT - K) T', so a state is stable if the eigenvalues of C^-1 (dP/dT - K) are negative.
The gain is the eigenvalue of K^-1 dP/dT of the largest magnitude: with one part
g = (dP/dT)/(dQ/dT), and changes decay with the time constant C/(K (1 - g)).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..model.network import HOUSING, OIL
from ..scene import Scene, SceneError
from ..scene.thermal import COLDEST, HOTTEST, NODES, SOURCES, Temperatures
from .conduction import FELT, SMALL, Conduction, gain_of
from .heat_curve import HeatCurve
from .steady_search import SteadySearch

Array = NDArray[np.float64]

ITERATIONS = 100
LONGEST_STEP = 20.0  # [K] of Newton's method
CONVERGED = 1e-10  # [K] of its last step
EXACT = 1e-9  # [W] over all heat, of a solution
ROUNDING = 4.0 * np.finfo(float).eps  # of flows, relative: differences of products
APART = 1e-3  # [K] between different solutions


class SteadyState(NamedTuple):
    """A state in which all temperatures stay."""

    temperatures: dict[str, float]
    """By part [K]."""
    heat: dict[str, float]
    """By source [W]."""
    gain: float
    """Feedback gain of the losses [-]; above 1 the state is unstable."""
    stable: bool
    """Whether small changes decay."""
    time_constants: tuple[float, ...]
    """Of small changes [s], the longest first; negative where they grow."""
    per_ambient: float
    """Change of the oil temperature per change of the ambient temperature [-]."""

    @property
    def loss(self) -> float:
        """Sum of the heat [W]."""
        return sum(self.heat.values())


class SteadyTemperatures:
    """Steady states of a scene at its operating point.

    Args:
        scene: the scene, with the section `thermal`.

    Raises:
        SceneError: the scene has no section `thermal`.
        ValueError: there is no equilibrium of forces.
    """

    def __init__(self, scene: Scene) -> None:
        if scene.thermal is None:
            raise SceneError("thermal: missing; the command and the start need this section")
        self.curve = HeatCurve(scene)
        """Heat over temperature."""
        self._conduction = Conduction(scene)
        between, to_air = self._conduction.conductances, self._conduction.to_air
        self._search = SteadySearch(self.curve, between, to_air)

    @property
    def states(self) -> tuple[SteadyState, ...]:
        """All steady states in the range of temperatures, the coldest first."""
        found: list[Array] = []
        for each in self._solutions():
            inside = (each >= COLDEST).all() and (each <= HOTTEST).all()
            if inside and all(np.abs(each - other).max() > APART for other in found):
                found.append(each)
        found.sort(key=lambda each: float(each[OIL]))
        return tuple(map(self._state, found))

    def _solutions(self) -> Array:
        """Solutions of Newton's method from wherever one may be [K], (n, nodes)."""
        values = self._search.starts()
        if not len(values):
            return values
        for _ in range(ITERATIONS):
            flow, slope = self._conduction.outflow(values)
            heat = self.curve(values @ FELT.T) @ self._conduction.share
            residual = heat - flow
            step = np.linalg.solve(slope - self._heating(values), residual[..., None])[..., 0]
            size = np.abs(step).max(axis=1, keepdims=True)
            values = values + step * np.minimum(1.0, LONGEST_STEP / np.maximum(size, 1e-300))
            if size.max() < CONVERGED:
                break
        flow, _ = self._conduction.outflow(values)
        residual = self.curve(values @ FELT.T) @ self._conduction.share - flow
        scale = max(float(np.abs(self.curve.heat).sum(axis=1).max()), 1e-6)
        rounding = ROUNDING * np.abs(self._conduction.between).sum(axis=1).max() * HOTTEST
        solved = np.abs(residual).max(axis=1) <= EXACT * scale + rounding
        return np.asarray(values[solved])

    def _heating(self, values: Array) -> Array:
        """Derivative of the heat of the parts with respect to their temperatures [W/K]."""
        return self._conduction.heating(self.curve(values @ FELT.T, slope=True))

    def _state(self, values: Array) -> SteadyState:
        """The steady state with these temperatures [K], (nodes,)."""
        conduction = self._conduction
        (_,), (leaving,) = conduction.outflow(values[None])
        heating = self._heating(values[None])[0]
        rates = np.linalg.eigvals((heating - leaving) / conduction.capacity[:, None]).real
        ambient = conduction.ambient
        conduction.ambient = ambient + SMALL
        pushed = conduction.released(float(values[HOUSING]))[0]
        conduction.ambient = ambient
        push = np.zeros(len(NODES))
        push[HOUSING] = (conduction.released(float(values[HOUSING]))[0] - pushed) / SMALL
        answer = np.linalg.solve(leaving - heating, push)
        heat = self.curve(FELT @ values)
        constants = np.sort(-1.0 / rates)[::-1]
        return SteadyState(
            temperatures=dict(zip(NODES, values.tolist(), strict=True)),
            heat=dict(zip(SOURCES, heat.tolist(), strict=True)),
            gain=gain_of(leaving, heating),
            stable=bool((rates < 0.0).all()),
            time_constants=tuple(constants.tolist()),
            per_ambient=float(answer[OIL]),
        )


def with_start(scene: Scene) -> Scene:
    """Replace a steady start by the temperatures of the steady state.

    Args:
        scene: any scene.

    Returns:
        The scene, with these temperatures if its start is steady.

    Raises:
        SceneError: not exactly one steady state is stable.
    """
    if scene.thermal is None or scene.thermal.start != "steady":
        return scene
    stable = [state for state in SteadyTemperatures(scene).states if state.stable]
    if len(stable) != 1:
        texts = ", ".join(f"{each.temperatures['oil']:.1f} K" for each in stable) or "none"
        raise SceneError(
            f"thermal.start = 'steady': {len(stable)} steady states of the oil are stable "
            f"({texts}) within {COLDEST:g} and {HOTTEST:g} K: give temperatures"
        )
    start = Temperatures(**stable[0].temperatures)
    return scene.model_copy(update={"thermal": scene.thermal.model_copy(update={"start": start})})
