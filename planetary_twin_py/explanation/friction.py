"""Friction of a mesh by each friction law, and the film laws within their range."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from .._core import tooth_contact
from ..model.oil import build_oil
from ..scene import Scene
from .mean_friction import contacts_of, mean_coefficient, oil_with

SLIDE_TO_ROLL = 0.1  # typical of a tooth pair between pitch point and tip
LARGEST_EXPONENT = 200.0  # beyond, the limiting stress has long been reached


class TypicalPair(NamedTuple):
    """A tooth pair with the whole mesh force and the radii of curvature next to the pitch point."""

    rho1: float  # radii of curvature [m]
    rho2: float
    external: float  # +1, or -1 of an internal mesh
    speed: float  # mean surface speed [m/s]
    load: float  # [N]

    @property
    def motion(self) -> tuple[float, float, float, float, float, float]:
        """Argument of `tooth_contact` at the slide-to-roll ratio SLIDE_TO_ROLL."""
        fast, slow = (self.speed * (1.0 + sign * 0.5 * SLIDE_TO_ROLL) for sign in (1.0, -1.0))
        turns = fast / self.rho1, -self.external * slow / self.rho2
        return self.rho1, self.rho2, self.external, *turns, self.load


def friction_figures(
    scene: Scene, kind: int, loaded: tuple[float, float], frequency: float
) -> dict[str, Any]:
    """Mean friction over the path of contact at the operating point of `scene`, and its film.

    Args:
        scene: the scene.
        kind: 0 for sun-planet meshes, 1 for planet-ring meshes.
        loaded: force of the mesh [N], negative on the coast flanks, and the largest Hertz pressure
            of one pair under this force, see `pitch_pressure` [Pa].
        frequency: mesh frequency [Hz].

    Returns:
        The friction fields of `MeshFigures`, by name.
    """
    mesh, (force, peak) = scene.gearset.geometry.meshes[kind], loaded
    contacts = contacts_of(scene, kind, force, frequency)
    loss_factor = contacts.loss_factor if force else None
    mu = mean_coefficient(build_oil(scene, scene.operating_point), contacts)
    by_law = {
        law: mean_coefficient(oil_with(scene, law), contacts)
        for law in ("eyring", "evans_johnson", "schlenk")
    }
    power = scene.gearset.planets * abs(force) * mesh.base_pitch * frequency
    curvatures, gears = mesh.curvatures_at(mesh.path.nearest), (mesh.first, mesh.second)
    speed = sum(
        math.pi * frequency * radius / gear.teeth
        for radius, gear in zip(curvatures, gears, strict=True)
    )
    pair = TypicalPair(*curvatures, -1.0 if mesh.internal else 1.0, speed, abs(force))
    shear = _shear_number(scene, pair, 0.25 * math.pi * peak)
    plateau = shear >= 1.0 and _has_plateau(scene, pair)
    return {
        "friction": mu,
        "friction_eyring": by_law["eyring"],
        "friction_evans_johnson": by_law["evans_johnson"] if plateau else None,
        "friction_schlenk": by_law["schlenk"],
        "loaded_loss_factor": loss_factor,
        "tooth_loss": mu * (loss_factor or 0.0) * power if scene.lubrication.friction else 0.0,
        "shear_number": shear,
        "film_laws_in_range": ("eyring", "evans_johnson") if plateau else ("eyring",),
    }


def _has_plateau(scene: Scene, pair: TypicalPair) -> bool:
    """Whether the plateau, which does not depend on the sliding speed, is positive.

    The law clips it to zero if it is negative.
    """
    viscous: float = tooth_contact(oil_with(scene, "evans_johnson"), pair.motion)[2]
    return viscous > 0.0


def _shear_number(scene: Scene, pair: TypicalPair, pressure: float) -> float:
    """eta Vs/(h tau0) [-], with eta at the mean pressure [Pa]; Newtonian if well below 1."""
    oil = build_oil(scene, scene.operating_point)
    log_film = tooth_contact(oil, pair.motion)[3]
    exponent = scene.lubrication.pressure_viscosity * pressure
    exponent += oil.shear_thinning.log_shear_time - log_film
    return SLIDE_TO_ROLL * pair.speed * math.exp(min(exponent, LARGEST_EXPONENT))
