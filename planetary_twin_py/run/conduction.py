"""Heat that leaves the parts of a gearbox, and its change with their temperatures."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .. import _core
from .._core import Network
from ..model.network import HOUSING, OIL, PLANETS, RING, SUN, build_network
from ..model.oil import build_oil
from ..scene import Scene
from ..scene.thermal import NODES, SOURCES

Array = NDArray[np.float64]

SMALL = 1e-3  # [K] of a difference quotient

# Share of each part in the temperature of each source.
FELT = np.zeros((len(SOURCES), len(NODES)))
FELT[0, [SUN, PLANETS]] = FELT[1, [PLANETS, RING]] = 0.5
FELT[2:, OIL] = 1.0


class Conductances(NamedTuple):
    """Conductances between the oil and the other parts, and of the cooler [W/K]."""

    sun: float
    planets: float
    ring: float
    housing: float
    cooling: float
    opens: float
    """[K] at which the cooler opens."""


class Conduction:
    """Conduction between the parts, to the ambient air and to the cooler.

    Args:
        scene: the scene, with the section `thermal`.
    """

    def __init__(self, scene: Scene) -> None:
        self._network: Network = build_network(scene, build_oil(scene, scene.operating_point))
        self.share = np.array(self._network.share)
        """Share of the heat of each source that a part takes, (sources, nodes)."""
        self.capacity = np.array(self._network.capacity)
        """Heat capacities [J/K], (nodes,)."""
        conductance = np.array(self._network.conductance)
        self.between = np.diag(conductance.sum(axis=1)) - conductance
        """Heat that leaves the parts to one another, over their temperatures [W/K], (n, n)."""

    @property
    def ambient(self) -> float:
        """Temperature of the ambient air [K]."""
        return float(self._network.ambient)

    @ambient.setter
    def ambient(self, temperature: float) -> None:
        self._network.ambient = temperature

    @property
    def conductances(self) -> Conductances:
        """What lies between the oil and the other parts."""
        network, others = self._network, (SUN, PLANETS, RING, HOUSING)
        sun, planets, ring, housing = (float(network.conductance[OIL, n]) for n in others)
        return Conductances(sun, planets, ring, housing, network.cooling, network.opens)

    def heating(self, slope: Array) -> Array:
        """Change of the heat of the parts with their temperatures.

        Args:
            slope: of the heat of each source over its temperature [W/K], (..., sources).

        Returns:
            The derivative [W/K], (..., nodes, nodes).
        """
        return np.asarray(np.einsum("sn,...s,sm->...nm", self.share, slope, FELT))

    def outflow(self, values: Array) -> tuple[Array, Array]:
        """Heat that leaves the parts.

        Args:
            values: temperatures [K], (n, nodes).

        Returns:
            The heat [W], (n, nodes), and its derivative [W/K], (n, nodes, nodes).
        """
        network = self._network
        flow = values @ self.between
        slope = np.broadcast_to(self.between, (len(values), *self.between.shape)).copy()
        released = np.array([self.released(at) for at in values[:, HOUSING]])
        flow[:, HOUSING] += released[:, 0]
        slope[:, HOUSING, HOUSING] += released[:, 1]
        above = values[:, OIL] - network.opens
        opened = (above > 0.0) & (network.cooling > 0.0)
        flow[:, OIL] += np.where(opened, network.cooling * above, 0.0)
        slope[:, OIL, OIL] += np.where(opened, network.cooling, 0.0)
        return flow, slope

    def released(self, housing: float) -> tuple[float, float]:
        """Heat to the ambient air [W] and its derivative with respect to the housing's [W/K]."""
        low, high = (self.to_air(housing + sign * SMALL) for sign in (-1.0, 1.0))
        return self.to_air(housing), (high - low) / (2.0 * SMALL)

    def to_air(self, housing: float) -> float:
        """Heat that a housing of a temperature [K] gives to the ambient air [W]."""
        network = self._network
        network.temperature[HOUSING] = housing
        return float(_core.to_ambient_air(network) * (housing - network.ambient))


def gain_of(leaving: Array, heating: Array) -> float:
    """Feedback gain of the losses.

    Args:
        leaving: derivative of the heat that leaves the parts [W/K], (nodes, nodes).
        heating: derivative of the heat that they get [W/K], (nodes, nodes).

    Returns:
        Eigenvalue of leaving^-1 heating of the largest magnitude [-]; above 1 a state is unstable.
    """
    gains = np.linalg.eigvals(np.linalg.solve(leaving, heating)).real
    return float(gains[np.abs(gains).argmax()])
