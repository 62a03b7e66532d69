"""How depths of wear grow: loads follow the profile, and the profile follows the loads.

The state is the depth at the grid of both kinds of mesh. It advances in steps of the dose, the
wear coefficient times the time, by the midpoint rule. A step changes no gap by more than
`CHANGE` or `OF_DEFLECTION` of the deflection, the smaller of them, and it is at most `OF_LIMIT` of
that at which an explicit step no longer lets loads level, 2/(growth x stiffness).
The forces of the meshes are those of a run, which is repeated as the depths change.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ...model.layout import Layout
from ...scene import Scene
from ...scene.worn import DEEPEST
from ...units.engineering import figure
from .flanks import POINTS, Depths, Flanks
from .forces import run_forces
from .worn_scene import worn_scene

Array = NDArray[np.float64]

CHANGE = 1e-7  # [m] of a gap in a step
OF_DEFLECTION = 0.02
OF_LIMIT = 0.1
OF_VIBRATION = 0.1  # of the deflection, after which a run with vibration is repeated; one in
# equilibrium is repeated after OF_DEFLECTION
MOST_STEPS = 20_000

State = tuple[Depths, Depths]


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
        self._of_run: State | None = None  # depths of the last run
        self.forces: tuple[Array, Array]
        """Force of the mesh of each planet as a pair passes the grid [N], (planets, points)."""
        self._renew()

    def rates(self, depths: State) -> State:
        """Growth of depths with the dose [m Pa/s]."""
        sun, ring = (
            f.rates(f.loads(d, force))
            for f, d, force in zip(self.flanks, depths, self.forces, strict=True)
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
        """Find the forces of the meshes, if depths have changed by more than they may."""
        most = (OF_VIBRATION if self._vibration else OF_DEFLECTION) * self._deflection
        if self._of_run is not None and self._moved(self._of_run) <= most:
            return
        self._of_run = self.depths
        worn = worn_scene(self.scene, self.flanks, self.depths)
        self.forces = run_forces(worn, self.flanks, self._vibration)

    def _moved(self, before: State) -> float:
        """Largest change of a gap, or of the wear of a planet beyond the mean [m]."""
        changes = (
            (now.first + now.second - was.first - was.second, now.planets - was.planets)
            for now, was in zip(self.depths, before, strict=True)
        )
        return max(float(np.abs(each).max()) for pair in changes for each in pair)

    def shares(self, kind: int) -> Array:
        """Mean force of the mesh of each planet over that of all, (planets,).

        Args:
            kind: 0 for sun-planet meshes, 1 for planet-ring meshes.
        """
        mean = self.forces[kind][:, :POINTS].mean(axis=1)  # of one mesh cycle
        return np.asarray(mean / mean.mean())
