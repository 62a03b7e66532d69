"""Which part of a gearbox fails first under a duty, from the damage that it has already."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

import numpy as np
from numpy.typing import NDArray

from ..scene import Scene
from .reliability import scatter_of, system_quantile, system_reliability

Array = NDArray[np.float64]

TENTH = 0.1
MOST = 1000.0  # Miner sum of a part in a gearbox


class Ageing:
    """Lives of the parts of a gearbox under a duty.

    Args:
        scene: the gearbox.
        parts: names, see `durability.parts`.
        rate: Miner sums over time [1/s], (parts,).
        reached: Miner sums so far, by part; None: new.

    Raises:
        ValueError: there is no such part, or a sum is below 0 or above 1000.
    """

    def __init__(
        self,
        scene: Scene,
        parts: tuple[str, ...],
        rate: Array,
        reached: Mapping[str, float] | None,
    ) -> None:
        self.parts = parts
        """Names of the parts."""
        self.reached = _reached(parts, reached)
        """Miner sums so far, (parts,)."""
        with np.errstate(divide="ignore"):
            self.life = 1.0 / rate
            """Time until the damage is 1, from new [s], (parts,)."""
        self.scatter = [scatter_of(scene, part) for part in parts]
        """Scatter of the lives of each part."""

    @property
    def first(self) -> int | None:
        """Place of the part whose damage is 1 first; None without damage."""
        return self._first(range(len(self.parts)))

    @property
    def first_level(self) -> int | None:
        """That of teeth and bearings, whose damage follows from the levels of the torque."""
        names = enumerate(self.parts)
        return self._first(place for place, part in names if not part.endswith("_shaft"))

    def failures(self, time: float) -> tuple[float, float]:
        """Reliability of gearboxes that have the damage so far.

        Args:
            time: from now [s].

        Returns:
            The share in which no part fails in this time, and the time in which a part fails in
            10 % of them [s].
        """
        ageing = np.flatnonzero(np.isfinite(self.life))
        weibulls = [self.scatter[part].weibull(float(self.life[part])) for part in ageing]
        ages = (self.reached[ageing] * self.life[ageing]).tolist()
        return (
            system_reliability(weibulls, time, ages),
            system_quantile(weibulls, TENTH, ages),
        )

    def _first(self, places: Iterable[int]) -> int | None:
        left = left_until_one(self.life, self.reached)
        ageing = [place for place in places if math.isfinite(left[place])]
        return min(ageing, key=lambda place: (left[place], -self.reached[place]), default=None)


def left_until_one(life: Array, reached: Array) -> Array:
    """Times until Miner sums are 1.

    Args:
        life: from new [s], (parts,); infinite without damage.
        reached: Miner sums now, (parts,).

    Returns:
        [s], (parts,); 0 of sums of 1 or more that grow.
    """
    share = np.maximum(1.0 - reached, 0.0)
    return np.multiply(share, life, out=np.full(len(life), math.inf), where=np.isfinite(life))


def _reached(parts: tuple[str, ...], reached: Mapping[str, float] | None) -> Array:
    given = reached or {}
    for name, value in given.items():
        if name not in parts:
            raise ValueError(f"reached: {name!r}: no such part; there are {', '.join(parts)}")
        if not 0.0 <= value <= MOST:
            raise ValueError(
                f"reached: {name} = {float(value):g}: must be within 0 and {MOST:g}, which no part "
                "survives: set parts that were replaced to 0"
            )
    return np.array([given.get(part, 0.0) for part in parts])
