"""Tooth loss by the friction law of a scene and by a second one, and how it depends on the oil."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from ..lubrication.viscosity import viscosity_at
from ..model.gearbox import Gearbox
from ..model.oil import build_oil
from ..scene import Scene
from ..scene.oil_grade import DEFINED
from ..units.engineering import figure
from .mean_friction import Contacts, contacts_of, mean_coefficient

REGRESSION = "schlenk"
"""Law that is fitted to measured losses of gears."""
_OTHER = "eyring"
Meshes = list[tuple[Contacts, float]]  # tooth pairs of each kind of mesh, and its power [W]
_STEP = 1.1  # ratio of viscosities for the exponents
_CLOSE = 0.1  # difference of exponents, below which both laws choose much the same oil


class LawFigures(NamedTuple):
    """Tooth loss by a friction law."""

    traction: str
    """Law, as in `lubrication.traction`."""
    tooth_loss: float
    """Of all meshes under the mean force, without vibration [W]."""
    viscosity_exponent: float
    """n of a loss that is proportional to viscosity^n at the operating point."""


class OilFigures(NamedTuple):
    """The oil of a scene at its operating point."""

    viscosity: float
    """At the oil temperature [Pa s]."""
    iso_vg: int | None
    """Grade, if the scene states it."""
    oil_temperature: float
    """[K]"""
    composite_roughness: float
    """Root of the sum of the squared rms roughness, Rq, of both flanks [m]."""
    laws: tuple[LawFigures, LawFigures]
    """The law of the scene, and another."""

    def as_figures(self) -> dict[str, Any]:
        """The same for JSON, in SI."""
        return self._asdict() | {"laws": [law._asdict() for law in self.laws]}

    @property
    def lines(self) -> Iterator[str]:
        """Sentences for a user."""
        grade = "" if self.iso_vg is None else f" ISO VG {self.iso_vg}"
        sigma = self.composite_roughness
        yield (
            f"oil{grade} at {self.oil_temperature - 273.15:.4g} degC: "
            f"{1e3 * self.viscosity:.4g} mPa s; composite roughness {1e6 * sigma:.3g} um, the root "
            "of Rq^2 of one flank + Rq^2 of the other: "
            f"Ra {1e6 * sigma / math.sqrt(math.pi):.3g} um of two equal flanks"
        )
        own, other = self.laws
        measured = ", a regression of measured losses" if other.traction == REGRESSION else ""
        yield f"tooth loss under the mean force: {_by(own)}; {_by(other)}{measured}"
        if line := self.too_thick:
            yield line

    @property
    def too_thick(self) -> str | None:
        """A sentence if the law of the scene favours thick oils."""
        own, other = self.laws
        if own.viscosity_exponent >= other.viscosity_exponent - _CLOSE:
            return None
        return (
            f"by {own.traction}, a thicker oil saves more than by {other.traction} (viscosity^"
            f"{own.viscosity_exponent:.2f} and ^{other.viscosity_exponent:.2f}): an oil chosen by "
            "it alone is likely too thick; compare oils by both laws (lubrication.traction)"
        )


def oil_of_scenes(scenes: Sequence[Scene]) -> str | None:
    """Warn if a comparison of oils rests on a law that favours thick ones.

    Args:
        scenes: scenes that are compared.

    Returns:
        A sentence, or None.
    """
    oils = {
        (
            *(getattr(each.lubrication, name) for name in DEFINED),
            each.operating_point.oil_temperature,
        )
        for each in scenes
    }
    if len(oils) < 2:
        return None
    found = filter(None, map(oil_figures, scenes))
    return next(filter(None, (oil.too_thick for oil in found)), None)


def oil_figures(scene: Scene) -> OilFigures | None:
    """Figures of the oil of `scene`; None without friction, force or speed."""
    gearbox = Gearbox(scene).held
    scene, point, data = gearbox.scene, scene.operating_point, scene.lubrication
    passing = float(gearbox.train.cycle.per_turn @ gearbox.operation(point).target_speed)
    frequency = abs(passing) / (2.0 * math.pi)
    force = gearbox.mesh_force(point.input_torque)
    if not data.friction or force == 0.0 or frequency == 0.0:
        return None
    powers = [
        scene.gearset.planets * abs(force) * mesh.base_pitch * frequency
        for mesh in scene.gearset.geometry.meshes
    ]
    meshes = [
        (contacts_of(scene, kind, force, frequency), power) for kind, power in enumerate(powers)
    ]
    other = REGRESSION if data.traction != REGRESSION else _OTHER
    reference = data.reference_temperature, data.viscosity
    viscosity = viscosity_at(
        point.oil_temperature, reference, data.viscosity_slope, data.oil_density
    )
    own, second = (_law(scene, law, viscosity, meshes) for law in (data.traction, other))
    return OilFigures(
        viscosity, data.iso_vg, point.oil_temperature, data.composite_roughness, (own, second)
    )


def _law(scene: Scene, traction: str, viscosity: float, meshes: Meshes) -> LawFigures:
    """Tooth loss by a law, and its logarithmic slope over the viscosity at the oil temperature."""
    changes = {"traction": traction, "reference_temperature": scene.operating_point.oil_temperature}
    thin, loss, thick = (
        _loss(scene, changes | {"viscosity": factor * viscosity}, meshes)
        for factor in (1.0 / _STEP, 1.0, _STEP)
    )
    return LawFigures(traction, loss, math.log(thick / thin) / math.log(_STEP**2) if loss else 0.0)


def _loss(scene: Scene, changes: dict[str, object], meshes: Meshes) -> float:
    """Tooth loss of all meshes with another oil [W]."""
    data = scene.lubrication.model_copy(update=changes)
    oil = build_oil(scene.model_copy(update={"lubrication": data}), scene.operating_point)
    return sum(
        mean_coefficient(oil, contacts) * contacts.loss_factor * power for contacts, power in meshes
    )


def _by(law: LawFigures) -> str:
    exponent = round(law.viscosity_exponent, 2) + 0.0
    return (
        f"{figure(law.tooth_loss, 'W')} by {law.traction}, proportional to viscosity^{exponent:.2g}"
    )
