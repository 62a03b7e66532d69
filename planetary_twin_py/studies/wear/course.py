"""How depths of wear grow: loads follow the profile, and the profile follows the loads.

The state is the depth at the grid of both kinds of mesh. It advances in steps of the dose, the
wear coefficient times the time, by the midpoint rule. A step changes no gap by more than
`CHANGE` or `OF_DEFLECTION` of the deflection, the smaller of them, and it is at most `OF_LIMIT` of
that at which an explicit step no longer lets loads level, 2/(growth x stiffness).
Load shares of the planets are renewed as the wear of single planets changes, and runs with
vibration as gaps change.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...model.layout import Layout
from ...scene import Scene
from ...scene.worn import DEEPEST
from ...units.engineering import figure
from .flanks import Depths, Flanks
from .shares import planet_shares
from .vibration import load_factors
from .worn_scene import worn_scene

Array = NDArray[np.float64]

CHANGE = 1e-7  # [m] of a gap in a step
OF_DEFLECTION = 0.02
OF_LIMIT = 0.1
OF_VIBRATION = 0.1  # of the deflection, after which a run with vibration is made again
MOST_STEPS = 20_000

State = tuple[Depths, Depths]


class Loads(NamedTuple):
    """What loads the pairs besides their own profile."""

    shares: Array
    """Mean force of each mesh over that of its kind, (2, planets)."""
    factors: list[Array]
    """Load with vibration over that without, at the grid of each kind."""


class Course:
    """Wear of all flanks over the dose.

    Args:
        scene: scene with a wear law.
        vibration: whether the loads are those of a run with the dynamics of the scene; otherwise
            those of static equilibrium.
    """

    def __init__(self, scene: Scene, vibration: bool) -> None:
        self.scene, self._vibration = scene, vibration
        self.flanks = Flanks(scene, 0), Flanks(scene, 1)
        self.force = abs(Layout(scene).mesh_force(scene.operating_point.input_torque))
        """Mean force of a mesh [N]."""
        self.depths: State = (self.flanks[0].start, self.flanks[1].start)
        found = [f.pairs.at(f.position, self.force).deflection for f in self.flanks]
        self._deflection = float(min(deflection.min() for deflection in found))
        self.longest = OF_LIMIT * 2.0 / max(f.sensitivity(self.force) for f in self.flanks)
        """Longest step of the dose [s/Pa]."""
        self._offsets: Array | None = None  # of the planets, when their shares were computed
        self._gaps: Array | None = None  # when a run with vibration was made
        even = np.ones((2, scene.gearset.planets))
        self.loads = Loads(even, [np.ones(len(f.position)) for f in self.flanks])
        self._renew()

    def rates(self, depths: State) -> State:
        """Growth of depths with the dose [m Pa/s]."""
        sun, ring = (
            f.rates(f.loads(d, self.force * share, factor))
            for f, d, share, factor in zip(
                self.flanks, depths, self.loads.shares, self.loads.factors, strict=True
            )
        )
        return sun, ring

    def steps(self, most: float, step: float | None = None) -> Iterator[float]:
        """Wear step by step.

        Args:
            most: dose at which it ends [s/Pa].
            step: of the dose [s/Pa], at most `longest`; None: as large as the accuracy allows.

        Yields:
            The dose after each step.

        Raises:
            ValueError: there are too many steps, or wear is deeper than a scene may have.
        """
        dose = 0.0
        for _ in range(MOST_STEPS):
            if dose >= most:
                return
            rate = self.rates(self.depths)
            size = min(most - dose, self._largest(rate) if step is None else step)
            if size == most - dose:
                dose = most
            else:
                dose += size
            sun, ring = (d.plus(r, 0.5 * size) for d, r in zip(self.depths, rate, strict=True))
            rate = self.rates((sun, ring))
            sun, ring = (d.plus(r, size) for d, r in zip(self.depths, rate, strict=True))
            self.depths = sun, ring
            self._check_depth()
            self._renew()
            yield dose
        raise ValueError(
            f"wear: takes more than {MOST_STEPS} steps, of at most {figure(CHANGE, 'm')} each: "
            "give fewer hours or a smaller coefficient"
        )

    def _largest(self, rate: State) -> float:
        """Largest step of the dose that is accurate [s/Pa]."""
        fastest = max(float((each.first + each.second).max()) for each in rate)
        change = min(CHANGE, OF_DEFLECTION * self._deflection)
        return min(self.longest, change / fastest) if fastest > 0.0 else math.inf

    def _check_depth(self) -> None:
        deepest = max(float(np.abs(each).max()) for depths in self.depths for each in depths)
        if not deepest <= DEEPEST:
            raise ValueError(
                f"wear: is deeper than {figure(DEEPEST, 'm')}: give fewer hours or a smaller "
                "coefficient"
            )

    def _renew(self) -> None:
        """Find shares and factors, if the depths have changed by more than they may."""
        worn = worn_scene(self.scene, self.flanks, self.depths)
        offsets = np.array([depths.planets for depths in self.depths])
        if self._offsets is None or self._exceeds(offsets - self._offsets, OF_DEFLECTION):
            self._offsets = offsets
            shares = planet_shares(worn, self.flanks[0].frequency)
            self.loads = self.loads._replace(shares=shares)
        gaps = np.concatenate([depths.first + depths.second for depths in self.depths])
        if not self._vibration:
            return
        if self._gaps is None or self._exceeds(gaps - self._gaps, OF_VIBRATION):
            self._gaps = gaps
            factors = load_factors(worn, self.flanks, self.depths)
            self.loads = self.loads._replace(factors=factors)

    def _exceeds(self, change: Array, part: float) -> bool:
        return bool(np.abs(change).max() > part * self._deflection)
