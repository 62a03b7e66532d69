"""Friction of one tooth pair by each friction law, and the film laws within their range."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from .._core import tooth_contact
from ..dynamics.oil import build_oil
from ..scene import Scene

SLIDE_TO_ROLL = 0.1  # typical of a tooth pair between pitch point and tip
LARGEST_EXPONENT = 200.0  # beyond, the limiting stress has long been reached


class TypicalPair(NamedTuple):
    """A tooth pair with the whole mesh force and the radii of curvature of the pitch point."""

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
    """Friction of a typical tooth pair at the operating point of `scene`.

    Args:
        scene: the scene.
        kind: 0 for sun-planet meshes, 1 for planet-ring meshes.
        loaded: load of the pair [N], and its largest Hertz pressure [Pa].
        frequency: mesh frequency [Hz].

    Returns:
        The friction fields of `MeshFigures`, by name.
    """
    mesh, (load, peak) = scene.gearset.geometry.meshes[kind], loaded
    rho1, rho2 = mesh.curvatures
    speed = frequency * mesh.rolling_advance
    pair = TypicalPair(rho1, rho2, 1.0 if kind == 0 else -1.0, speed, load)
    by_law = {law: _friction(scene, law, pair) for law in ("eyring", "evans_johnson", "schlenk")}
    coefficients = {law: sum(parts) for law, parts in by_law.items()}
    shear = _shear_number(scene, pair, 0.25 * math.pi * peak)
    # The plateau is independent of the sliding speed, and is clipped to zero if negative.
    plateau = shear >= 1.0 and by_law["evans_johnson"][1] > 0.0
    return {
        "friction": sum(_friction(scene, scene.lubrication.traction, pair)),
        "friction_eyring": coefficients["eyring"],
        "friction_evans_johnson": coefficients["evans_johnson"] if plateau else None,
        "friction_schlenk": coefficients["schlenk"],
        "shear_number": shear,
        "film_laws_in_range": ("eyring", "evans_johnson") if plateau else ("eyring",),
    }


def _friction(scene: Scene, traction: str, pair: TypicalPair) -> tuple[float, float]:
    """Boundary and viscous friction coefficients [-] with a law of viscous friction."""
    oil = build_oil(scene.replace(**{"lubrication.traction": traction}), scene.operating_point)
    _, boundary, viscous, *_ = tooth_contact(oil, pair.motion)
    return (boundary / pair.load, viscous / pair.load) if pair.load else (0.0, 0.0)


def _shear_number(scene: Scene, pair: TypicalPair, pressure: float) -> float:
    """eta Vs/(h tau0) [-], with eta at the mean pressure [Pa]; Newtonian if well below 1."""
    oil = build_oil(scene, scene.operating_point)
    log_film = tooth_contact(oil, pair.motion)[3]
    exponent = scene.lubrication.pressure_viscosity * pressure
    exponent += oil.shear_thinning.log_shear_time - log_film
    return SLIDE_TO_ROLL * pair.speed * math.exp(min(exponent, LARGEST_EXPONENT))
