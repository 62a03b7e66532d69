"""What the damage of a run says about the parts of a gearbox."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from ..durability.damage import Damage
from ..durability.scuffing import margin, scuffing_temperature
from ..lubrication.viscosity import viscosity_at
from ..scene import Scene
from .pressure import LARGEST

HOUR = 3600.0  # [s]
FACE_REMARK = (
    "durability.face_load_factor = 1: the load is taken as even along the face, which the model "
    "does not compute: give the factor, for example 1.15; damage of flanks grows with about its "
    "6th power"
)


def hours_of_shortest(damage: Damage) -> float | None:
    """Hours to a Miner sum of 1 of the part with the shortest life, None without damage."""
    largest = float(damage.rate.max())
    return 1.0 / (largest * HOUR) if largest > 0.0 else None


def extremes_of(damage: Damage) -> dict[str, float | None]:
    """Largest stresses [Pa] and contact temperature [K] of all meshes, and the thinnest film."""
    found: dict[str, float | None] = {}
    for name, values in damage.peaks.items():
        known = values[~np.isnan(values)]
        pick = np.min if name == "specific_film" else np.max
        found[name] = float(pick(known)) if known.size else None
    return found


def scuffing_margin(scene: Scene, hottest: float | None) -> float | None:
    """Margin to the scuffing temperature, None without a limit or without friction.

    Args:
        scene: the scene.
        hottest: highest contact temperature [K].
    """
    section, point = scene.durability, scene.operating_point
    if section is None or section.scuffing is None or hottest is None:
        return None
    limit, data = section.scuffing.temperature, scene.lubrication
    if section.scuffing.fzg_stage is not None:
        reference = data.reference_temperature, data.viscosity
        viscosity = viscosity_at(
            point.oil_temperature, reference, data.viscosity_slope, data.oil_density
        )
        limit = scuffing_temperature(section.scuffing.fzg_stage, viscosity)
    assert limit is not None
    return margin(limit, hottest, point.oil_temperature)


def damage_figures(scene: Scene, damage: Damage) -> dict[str, Any]:
    """Damage for JSON, by part names; quantities in SI."""
    extremes = extremes_of(damage)
    per_tooth = damage.passages_per_tooth / damage.duration * HOUR
    return {
        "per_hour": dict(zip(damage.parts, (damage.rate * HOUR).tolist(), strict=True)),
        "passages_per_hour": dict(zip(damage.parts, per_tooth.tolist(), strict=True)),
        "shortest_lived": damage.shortest_lived or None,
        "hours_to_damage_1": hours_of_shortest(damage),
        "contact_stress_Pa": extremes["contact_stress"],
        "root_stress_Pa": extremes["root_stress"],
        "contact_temperature_K": extremes["contact_temperature"],
        "specific_film": extremes["specific_film"],
        "scuffing_margin": scuffing_margin(scene, extremes["contact_temperature"]),
        **_of_teeth(damage),
    }


def _of_teeth(damage: Damage) -> dict[str, dict[str, list[float]]]:
    """Damage of every tooth per hour by part names, where teeth are counted by themselves."""
    each = {
        part: (values / damage.duration * HOUR).tolist()
        for part, values in damage.of_teeth.damage.items()
    }
    return {"teeth_per_hour": each} if each else {}


def damage_remarks(scene: Scene, damage: Damage | None = None) -> Iterator[str]:
    """What the damage of a scene leaves out, or extrapolates, a line each."""
    section = scene.durability
    if section is None:
        return
    if section.face_load_factor == 1.0:
        yield FACE_REMARK
    if scene.gearset.helix_angle != 0.0:
        yield "durability: roots of helical teeth are not counted: their form factors are missing"
    elif not section.ring_root:
        yield "durability: the root of the ring is not counted without durability.ring_root: true"
    if damage is None:
        return
    extremes = extremes_of(damage)
    yield from _beyond_curves(scene, damage)
    film, limit = extremes["specific_film"], section.micropitting
    if film is not None and limit is not None and film < limit.permissible_film:
        yield (
            f"specific film = {film:.3g}: is below durability.micropitting.permissible_film = "
            f"{limit.permissible_film:g}: micropits are expected"
        )
    margin = scuffing_margin(scene, extremes["contact_temperature"])
    if margin is not None and margin < 1.0:
        yield f"contact temperature: exceeds the scuffing temperature, {margin:.3g} times the rise"


def _beyond_curves(scene: Scene, damage: Damage) -> Iterator[str]:
    """Stresses above the first point of an S-N curve, or where flanks yield below it."""
    from ..durability.strength import FLANK, ROOT

    assert scene.durability is not None
    for name, gear, value in _stresses(scene, damage):
        strength = getattr(scene.durability.material, gear)
        factors, limit = (
            (FLANK, strength.flank) if name == "contact" else (ROOT, 2.0 * strength.root)
        )
        most = factors[strength.treatment].factor[0] * limit
        if value > most:
            yield (
                f"{name} stress = {value / 1e6:.4g} MPa: is above the first point of the S-N curve "
                f"of the {gear}, {most / 1e6:.4g} MPa: its damage is extrapolated"
            )
        elif name == "contact" and value > LARGEST:
            yield (
                f"contact stress = {value / 1e6:.4g} MPa: the flanks of the {gear} yield above "
                f"{LARGEST / 1e6:.4g} MPa (hardened steel of 1.2 GPa, Johnson 1985), which its S-N "
                "curve does not count"
            )


def _stresses(scene: Scene, damage: Damage) -> Iterator[tuple[str, str, float]]:
    """Largest contact stress and root stress of each gear [Pa]; 0 where there is none."""
    planets = scene.gearset.planets
    contact, root = (
        np.nan_to_num(damage.peaks[name]) for name in ("contact_stress", "root_stress")
    )
    sun, ring = float(contact[:planets].max()), float(contact[planets:].max())
    for gear, value in (("sun", sun), ("planet", max(sun, ring)), ("ring", ring)):
        yield "contact", gear, value
    yield "root", "sun", float(root[0])
    yield "root", "planet", float(root[1 : 1 + planets].max())
    if scene.durability is not None and scene.durability.ring_root:
        yield "root", "ring", float(root[-1])
