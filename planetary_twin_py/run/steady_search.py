"""Where steady temperatures can be: a search that leaves out only what is proved to have none.

With the temperature x of the oil, heat balances of the gears give the temperatures of the meshes,

    m_1 = x + (q_1/G_sun + (q_1 + q_2)/G_planets)/4,   q_1(m_1), q_2(m_2): heat of the meshes,
    m_2 = x + ((q_1 + q_2)/G_planets + q_2/G_ring)/4,

and that of the housing, whose temperature rises with x, is solved by one value. So steady states
are the common zeros of two functions of m_1 and m_2: the difference of the x of both lines, and the
heat balance of the oil. A square of the plane has none if one of them is larger at its centre than
its slopes allow it to change up to the edge. The others are divided until they are small.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ..model.network import HOUSING, OIL, PLANETS, RING, SUN
from ..scene.thermal import COLDEST, HOTTEST, NODES, SOURCES
from .conduction import Conductances
from .heat_curve import HeatCurve

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

HALVINGS = 10  # of the squares between two temperatures of the curve
MOST = 20_000  # squares: near a fold all of them may stay for some halvings
AIR_STEP = 0.5  # [K] of the table of the heat to the ambient air
BEARINGS, SEALS, CHURNING = (SOURCES.index(name) for name in ("bearings", "seals", "churning"))


class SteadySearch:
    """Regions with steady states.

    Args:
        curve: heat over temperature.
        between: conductances.
        to_air: heat that a housing of a temperature [K] gives to the ambient air [W].
    """

    def __init__(
        self, curve: HeatCurve, between: Conductances, to_air: Callable[[float], float]
    ) -> None:
        self._curve, self._between = curve, between
        self._slopes = curve.steepest
        count = round((HOTTEST - COLDEST) / AIR_STEP) + 1
        self._housing = np.linspace(COLDEST, HOTTEST, count)
        self._air = np.array([to_air(float(each)) for each in self._housing])
        # Twice the error of a table of lines.
        self._slack = float(np.abs(np.diff(self._air, 2)).max()) / 4.0

    def starts(self) -> Array:
        """Temperatures beside every steady state in the range [K], (n, nodes)."""
        step = self._curve.temperature[1] - self._curve.temperature[0]
        cells = np.arange(len(self._curve.temperature) - 1)
        cell = np.stack(np.meshgrid(cells, cells), axis=-1).reshape(-1, 2)
        centre, half = self._curve.temperature[cell] + 0.5 * step, 0.5 * step
        for _ in range(HALVINGS):
            kept = self._possible(centre, half, cell)
            centre, cell = centre[kept], cell[kept]
            if len(centre) > MOST:
                break
            half *= 0.5
            moves = half * np.array([[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]])
            centre = (centre[:, None] + moves).reshape(-1, 2)
            cell = np.repeat(cell, len(moves), axis=0)
        return self._temperatures(centre[self._possible(centre, half, cell)])

    def _possible(self, centre: Array, half: float, cell: Indices) -> NDArray[np.bool_]:
        """Whether squares may have a steady state, (n,)."""
        sun, planets, ring = self._between[:3]
        first, second = self._slopes[0, cell[:, 0]], self._slopes[1, cell[:, 1]]
        apart, balance = self._residuals(centre)
        to_x = 1.0 + 0.25 * (first * (1.0 / sun + 1.0 / planets) + second / planets)
        of_apart = 2.0 + 0.25 * (first / sun + second / ring)
        of_balance = first + second + self._balance_slope() * to_x
        return np.asarray(
            (np.abs(apart) <= of_apart * half)
            & (np.abs(balance) <= of_balance * half + self._slack)
        )

    def _balance_slope(self) -> float:
        """Largest slope of the heat balance of the oil over its temperature [W/K]."""
        bearings, seals, churning = (
            float(self._slopes[source].max()) for source in (BEARINGS, SEALS, CHURNING)
        )
        air = float(np.diff(self._air).max()) / AIR_STEP
        housing = min(self._between.housing, air) + seals
        return bearings + churning + housing + self._between.cooling

    def _residuals(self, meshes: Array) -> tuple[Array, Array]:
        """Difference of both x [K], and heat that the oil keeps [W], (n,) each."""
        sun, _, ring = self._between[:3]
        oil, housing, heat = self._solved(meshes)
        given = np.interp(housing, self._housing, self._air) - heat[:, SEALS]
        apart = meshes[:, 0] - meshes[:, 1] - 0.25 * (heat[:, 0] / sun - heat[:, 1] / ring)
        cooled = self._between.cooling * np.maximum(oil - self._between.opens, 0.0)
        kept = heat[:, [0, 1, BEARINGS, CHURNING]].sum(axis=1) - given - cooled
        return apart, kept

    def _solved(self, meshes: Array) -> tuple[Array, Array, Array]:
        """Oil and housing [K], (n,), and heat of the sources [W], (n, sources)."""
        sun, planets, _, to_housing = self._between[:4]
        of_meshes = self._curve(np.repeat(meshes[:, :1], len(SOURCES), axis=1))[:, 0]
        of_rings = self._curve(np.repeat(meshes[:, 1:], len(SOURCES), axis=1))[:, 1]
        oil = meshes[:, 0] - 0.25 * (of_meshes / sun + (of_meshes + of_rings) / planets)
        heat = self._curve(np.repeat(oil[:, None], len(SOURCES), axis=1))
        heat[:, 0], heat[:, 1] = of_meshes, of_rings
        # What the housing takes from the oil and the seals at each of its temperatures.
        taken = self._air + to_housing * self._housing
        housing = np.interp(to_housing * oil + heat[:, SEALS], taken, self._housing)
        return oil, housing, heat

    def _temperatures(self, meshes: Array) -> Array:
        """Temperatures of all parts [K], (n, nodes)."""
        oil, housing, heat = self._solved(meshes)
        found = np.empty((len(meshes), len(NODES)))
        found[:, OIL], found[:, HOUSING] = oil, housing
        found[:, SUN] = oil + 0.5 * heat[:, 0] / self._between.sun
        found[:, PLANETS] = oil + 0.5 * (heat[:, 0] + heat[:, 1]) / self._between.planets
        found[:, RING] = oil + 0.5 * heat[:, 1] / self._between.ring
        return found
