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

from .. import _core
from .._core import Network
from ..model.network import HOUSING, OIL, PLANETS, RING, SUN, build_network
from ..model.oil import build_oil
from ..scene import Scene, SceneError
from ..scene.thermal import COLDEST, HOTTEST, NODES, SOURCES, Temperatures
from .heat_curve import HeatCurve
from .steady_search import Conductances, SteadySearch

Array = NDArray[np.float64]

ITERATIONS = 100
LONGEST_STEP = 20.0  # [K] of Newton's method
CONVERGED = 1e-10  # [K] of its last step
EXACT = 1e-9  # [W] over all heat, of a solution
ROUNDING = 4.0 * np.finfo(float).eps  # of flows, relative: differences of products
APART = 1e-3  # [K] between different solutions
SMALL = 1e-3  # [K] of a difference quotient

# Share of each part in the temperature of each source.
FELT = np.zeros((len(SOURCES), len(NODES)))
FELT[0, [SUN, PLANETS]] = FELT[1, [PLANETS, RING]] = 0.5
FELT[2:, OIL] = 1.0


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
        self._network: Network = build_network(scene, build_oil(scene, scene.operating_point))
        self._share = np.array(self._network.share)
        self._capacity = np.array(self._network.capacity)
        conductance = np.array(self._network.conductance)
        self._between = np.diag(conductance.sum(axis=1)) - conductance
        sun, planets, ring, housing = conductance[OIL, [SUN, PLANETS, RING, HOUSING]].tolist()
        network = self._network
        between = Conductances(sun, planets, ring, housing, network.cooling, network.opens)
        self._search = SteadySearch(self.curve, between, self._to_air)

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
            flow, slope = self._outflow(values)
            heat = self.curve(values @ FELT.T) @ self._share
            residual = heat - flow
            step = np.linalg.solve(slope - self._heating(values), residual[..., None])[..., 0]
            size = np.abs(step).max(axis=1, keepdims=True)
            values = values + step * np.minimum(1.0, LONGEST_STEP / np.maximum(size, 1e-300))
            if size.max() < CONVERGED:
                break
        flow, _ = self._outflow(values)
        residual = self.curve(values @ FELT.T) @ self._share - flow
        scale = max(float(np.abs(self.curve.heat).sum(axis=1).max()), 1e-6)
        rounding = ROUNDING * np.abs(self._between).sum(axis=1).max() * HOTTEST
        solved = np.abs(residual).max(axis=1) <= EXACT * scale + rounding
        return np.asarray(values[solved])

    def _heating(self, values: Array) -> Array:
        """Derivative of the heat of the parts with respect to their temperatures [W/K]."""
        slope = self.curve(values @ FELT.T, slope=True)
        return np.asarray(np.einsum("sn,...s,sm->...nm", self._share, slope, FELT))

    def _outflow(self, values: Array) -> tuple[Array, Array]:
        """Heat that leaves the parts [W], (n, nodes), and its derivative [W/K]."""
        network = self._network
        flow = values @ self._between
        slope = np.broadcast_to(self._between, (len(values), *self._between.shape)).copy()
        released = np.array([self._released(at) for at in values[:, HOUSING]])
        flow[:, HOUSING] += released[:, 0]
        slope[:, HOUSING, HOUSING] += released[:, 1]
        above = values[:, OIL] - network.opens
        opened = (above > 0.0) & (network.cooling > 0.0)
        flow[:, OIL] += np.where(opened, network.cooling * above, 0.0)
        slope[:, OIL, OIL] += np.where(opened, network.cooling, 0.0)
        return flow, slope

    def _released(self, housing: float) -> tuple[float, float]:
        """Heat to the ambient air [W] and its derivative with respect to the housing's [W/K]."""
        low, high = (self._to_air(housing + sign * SMALL) for sign in (-1.0, 1.0))
        return self._to_air(housing), (high - low) / (2.0 * SMALL)

    def _to_air(self, housing: float) -> float:
        network = self._network
        network.temperature[HOUSING] = housing
        return float(_core.to_ambient_air(network) * (housing - network.ambient))

    def _state(self, values: Array) -> SteadyState:
        """The steady state with these temperatures [K], (nodes,)."""
        (_,), (leaving,) = self._outflow(values[None])
        heating = self._heating(values[None])[0]
        gains = np.linalg.eigvals(np.linalg.solve(leaving, heating)).real
        rates = np.linalg.eigvals((heating - leaving) / self._capacity[:, None]).real
        ambient = self._network.ambient
        self._network.ambient = ambient + SMALL
        pushed = self._released(float(values[HOUSING]))[0]
        self._network.ambient = ambient
        push = np.zeros(len(NODES))
        push[HOUSING] = (self._released(float(values[HOUSING]))[0] - pushed) / SMALL
        answer = np.linalg.solve(leaving - heating, push)
        heat = self.curve(FELT @ values)
        constants = np.sort(-1.0 / rates)[::-1]
        return SteadyState(
            temperatures=dict(zip(NODES, values.tolist(), strict=True)),
            heat=dict(zip(SOURCES, heat.tolist(), strict=True)),
            gain=float(gains[np.abs(gains).argmax()]),
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
