"""The flanks of a kind of mesh that wear: how fast at every point of the path of contact."""

from __future__ import annotations

import math
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..._core import tooth_contact
from ...lubrication.wear import FILM_FACTORS, slips
from ...model.layout import Layout
from ...model.oil import build_oil
from ...model.path_loads import PathLoads, path_loads
from ...scene import Scene

Array = NDArray[np.float64]

POINTS = 50  # per base pitch, so that the pairs that share a load are at points of the grid


class Depths(NamedTuple):
    """Depths of the flanks of a kind of mesh, or their rates."""

    first: Array
    """Of the first gear [m], mean of its flanks, (points,)."""
    second: Array
    """Of the second gear [m], likewise."""
    planets: Array
    """By which each planet is worn further than their mean, over the path [m], (planets,)."""

    def plus(self, rate: Depths, dose: float) -> Depths:
        """These depths after a dose at a rate."""
        return Depths(*(a + dose * b for a, b in zip(self, rate, strict=True)))


class Flanks:
    """Flanks of a kind of mesh.

    Depths grow with the dose, the wear coefficient times the time [s/Pa], so that rates do not
    depend on the coefficient.

    Args:
        scene: scene with a wear law.
        kind: 0 for sun-planet meshes, 1 for planet-ring meshes.
    """

    def __init__(self, scene: Scene, kind: int) -> None:
        self.kind, self._scene = kind, scene
        self.mesh = scene.gearset.geometry.meshes[kind]
        self.position = _grid(self.mesh.path.approach, self.mesh.path.recess)
        self.pairs: PathLoads = path_loads(scene, kind)
        self.frequency = abs(Layout(scene).mesh_frequency)
        """Of the mesh [Hz]."""
        planets = scene.gearset.planets
        meshes = (1, planets) if kind else (planets, 1)
        gears = self.mesh.first, self.mesh.second
        self._passages = [self.frequency * n / g.teeth for n, g in zip(meshes, gears, strict=True)]
        self._oil = build_oil(scene, scene.operating_point)

    @property
    def start(self) -> Depths:
        """Depths that the scene has."""
        worn, none = self._scene.mesh.worn.meshes[self.kind], np.zeros_like(self.position)
        planets = self._scene.gearset.planets
        if worn is None:
            return Depths(none, none, np.zeros(planets))
        first, second = (
            np.interp(self.position, worn.position, each) for each in (worn.first, worn.second)
        )
        return Depths(first, second, np.array(worn.planets or (0.0,) * planets))

    @cached_property
    def slips(self) -> tuple[Array, Array]:
        """|1 - V2/V1| and |1 - V1/V2| at the grid, (points,) each."""
        return slips(self.mesh, self.position)

    def loads(self, depths: Depths, force: Array) -> Array:
        """Loads of the pairs of each planet at the grid [N], (planets, points).

        Args:
            depths: wear.
            force: of the mesh of each planet as a pair passes the grid [N], (planets, points).
        """
        pairs = self.pairs.worn(self.position, depths.first + depths.second)
        found = np.zeros(force.shape)
        for i, own in enumerate(force):
            stiffer = self._scene.errors.of_planet(i).stiffness
            present = own > 0.0
            load = pairs.at(self.position, np.where(present, own, 1.0) / stiffer).load
            found[i] = np.where(present, stiffer * load, 0.0)
        return found

    def rates(self, load: Array) -> Depths:
        """Growth of the depths with the dose [m Pa/s].

        Args:
            load: see `loads`.
        """
        line = load * self.film_factor(load.mean(axis=0)) / self._scene.gearset.face_width
        slip1, slip2 = self.slips
        first, second = (
            n * line.mean(axis=0) * s for n, s in zip(self._passages, (slip1, slip2), strict=True)
        )
        own = (line - line.mean(axis=0)) * (slip1 if self.kind else slip2)
        each = _mean(self.position, own) * self._passages[0 if self.kind else 1]
        return Depths(first, second, each)

    def film_factor(self, load: Array) -> Array:
        """Wear coefficient over that without film at the grid, (points,).

        Args:
            load: of a pair [N], (points,).
        """
        law = FILM_FACTORS[self._scene.durability.wear.film]  # type: ignore[union-attr]
        if self._scene.lubrication.lambda_ratio == "prescribed":
            return law(np.full(len(load), self._scene.operating_point.lambda_ratio))
        external = -1.0 if self.mesh.internal else 1.0
        turn = 2.0 * math.pi * self.frequency
        spin = turn / self.mesh.first.teeth, -external * turn / self.mesh.second.teeth
        rho1, rho2 = self.mesh.curvatures_at(self.position)
        logs = [
            tooth_contact(self._oil, (float(r1), float(r2), external, *spin, float(w)))[3]
            for r1, r2, w in zip(rho1, rho2, load, strict=True)
        ]
        return law(np.exp(np.array(logs) - self._oil.log_roughness))

    def sensitivity(self, force: float) -> float:
        """Largest rate at which loads of pairs and planets level with the dose [Pa/s].

        The gaps g of the pairs grow as dg/dq = -C J g with growths C per load, and with loads J g.
        The eigenvalues of C J are at most the largest product of growth and stiffness of a pair;
        those of the planets, of the mean growth and the stiffness of the mesh.

        Args:
            force: of the mesh [N].
        """
        unworn = self.pairs.worn(self.position, np.zeros_like(self.position))
        found = unworn.at(self.position, force)
        film = self.film_factor(found.load) / self._scene.gearset.face_width
        grown = film * sum(n * s for n, s in zip(self._passages, self.slips, strict=True))
        stiffness = found.load / found.deflection
        mesh = force / found.deflection.min()
        return float(np.max(grown * stiffness) + mesh * _mean(self.position, grown))

    def volumes(self, depths: Depths) -> tuple[float, float]:
        """Volume worn off all teeth of both gears [m^3], of the planets off all of them."""
        gears, rho = (self.mesh.first, self.mesh.second), self.mesh.curvatures_at(self.position)
        width, pitch = self._scene.gearset.face_width, self.mesh.base_pitch
        planets = self._scene.gearset.planets
        several = (planets, 1) if self.kind else (1, planets)
        # An arc of the flank is rho/r_b times the way of the contact on the line of action.
        first, second = (
            n * g.teeth * width * pitch / g.base_radius * float(np.trapezoid(d * r, self.position))
            for n, g, r, d in zip(several, gears, rho, depths[:2], strict=True)
        )
        return first, second


def _grid(approach: float, recess: float) -> Array:
    """Positions on a path, `POINTS` per base pitch from its start, and its end [base pitches]."""
    count = math.ceil(POINTS * (approach + recess) - 1e-6)
    return np.append(np.arange(count) / POINTS - approach, recess)


def _mean(position: Array, value: Array) -> Array:
    """Mean over the path of values at its positions, (..., points)."""
    way = position[-1] - position[0]
    return np.asarray(np.trapezoid(value, position, axis=-1) / way)
