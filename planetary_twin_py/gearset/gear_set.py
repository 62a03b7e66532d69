"""The three kinds of gears of a planetary set, and their two meshes."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache

from .geometry import pitch_radius
from .involute import DEDENDUM, TIP_ROUNDING, SpurGear
from .kinematics import Teeth
from .shift import PerGear, backlash_free_angle
from .working import WorkingMesh


@dataclass(frozen=True)
class GearSet:
    """Sun, planet and ring at a centre distance."""

    sun: SpurGear
    planet: SpurGear
    ring: SpurGear
    centre_distance: float
    """[m]"""

    @cached_property
    def meshes(self) -> tuple[WorkingMesh, WorkingMesh]:
        """The mesh of sun and planet, and that of planet and ring."""
        return (
            WorkingMesh(self.sun, self.planet, self.centre_distance),
            WorkingMesh(self.planet, self.ring, self.centre_distance),
        )

    @property
    def carrier_ratio(self) -> float:
        """Base radii (r_br - r_bp)/(r_bs + r_bp): 1 where ring = sun + 2 planet.

        It is how far the ring's mesh moves along its line of action with the carrier, over the same
        at the sun.
        """
        sun_planet, planet_ring = self.meshes
        return planet_ring.teeth / sun_planet.teeth


UNSHIFTED = PerGear(0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Sizes:
    """What a gear set follows from, in the transverse plane."""

    teeth: Teeth
    module: float
    """[m]"""
    pressure_angle: float
    """On the reference circles [rad]."""
    addendum: float = 1.0
    """Of the basic rack [modules]."""
    shift: PerGear = UNSHIFTED
    """Profile shifts, positive if they make teeth thicker [modules]."""
    centre_distance: float | None = None
    """[m]; default: sun and planets mesh without backlash."""
    tip_diameters: tuple[float | None, float | None, float | None] = (None, None, None)
    """Of sun, planet and ring [m]; default: see `build_gear_set`."""
    dedendum: float = DEDENDUM
    """Of the basic rack [modules]."""
    fillet: float = TIP_ROUNDING
    """Tip radius of the basic rack [modules]."""
    stated: float = 1.0
    """See `SpurGear`."""


def distance_without_play(sizes: Sizes, ring: bool = False) -> float | None:
    """Centre distance at which a mesh has no backlash (ISO 21771:2007, eqs. 60 and 62) [m].

    Args:
        sizes: of the gears.
        ring: whether the mesh is that of planet and ring; otherwise of sun and planet.

    Returns:
        The distance, None if there is none.
    """
    (sun, planet, outer), shift = sizes.teeth, sizes.shift
    teeth = planet - outer if ring else sun + planet
    total = shift.planet + (shift.ring if ring else shift.sun)
    reference = pitch_radius(abs(teeth), sizes.module)
    if total == 0.0:
        return reference
    angle = backlash_free_angle(teeth, total, sizes.pressure_angle)
    if angle is None or not angle < 0.5 * math.pi:
        return None
    return reference * math.cos(sizes.pressure_angle) / math.cos(angle)


@lru_cache(maxsize=64)
def build_gear_set(sizes: Sizes) -> GearSet:
    """Gears and centre distance.

    Tips that are not given are at the addendum plus the profile shift, lowered where they would
    leave less clearance to the mating root than the basic rack (tip alteration k of ISO 21771:2007,
    sec. 5.4): k m = a_w - a - m (x1 + x2), for internal meshes with the opposite sign; a planet
    takes the lower of its two meshes.

    Args:
        sizes: of the gears.

    Returns:
        The gear set.

    Raises:
        ValueError: sun and planets mesh without backlash at no centre distance, a tooth is
            pointed, or a tip circle is impossible; see `SpurGear`.
    """
    distance = sizes.centre_distance
    if distance is None:
        distance = distance_without_play(sizes)
    if distance is None:
        shifts = ", ".join(f"{x / sizes.stated:g}" for x in sizes.shift[:2])
        raise ValueError(
            f"gearset.profile_shift.sun, planet = {shifts}: "
            "their sum is too small: sun and planets mesh without backlash at no centre distance"
        )
    heights = _addenda(sizes, distance)
    sun, planet, ring = (_gear(sizes, kind, height) for kind, height in enumerate(heights))
    return GearSet(sun, planet, ring, distance)


def _gear(sizes: Sizes, kind: int, addendum: float) -> SpurGear:
    """Sun (0), planet (1) or ring (2)."""
    teeth, shift, internal = sizes.teeth[kind], sizes.shift[kind], kind == 2
    try:
        return SpurGear(
            teeth, sizes.module, sizes.pressure_angle, addendum, internal, shift,
            sizes.dedendum, sizes.fillet, sizes.stated,
        )  # fmt: skip
    except ValueError as error:
        reason = str(error).partition(": ")[2]
        height = addendum + shift
        tip = 1e3 * sizes.module * (teeth + 2.0 * (-height if internal else height))
        raise ValueError(
            f"gearset.teeth.{Teeth._fields[kind]} = {teeth}: {reason}: change the tip diameter of "
            f"{tip:.6g} mm, the profile shift of {shift / sizes.stated:g} or the pressure angle"
        ) from None


def _addenda(sizes: Sizes, distance: float) -> list[float]:
    """Heights of the tips above the reference circles, without profile shift [modules]."""
    (sun, planet, ring), shift, module = sizes.teeth, sizes.shift, sizes.module
    lower = [0.0, 0.0, 0.0]
    if any(shift) or sizes.centre_distance is not None or ring != sun + 2 * planet:
        at_sun = distance / module - 0.5 * (sun + planet) - (shift.sun + shift.planet)
        at_ring = 0.5 * (ring - planet) - (shift.planet + shift.ring) - distance / module
        lower = [min(0.0, at_sun), min(0.0, at_sun, at_ring), min(0.0, at_ring)]
    heights = []
    for kind, (z, given) in enumerate(zip(sizes.teeth, sizes.tip_diameters, strict=True)):
        if given is None:
            heights.append(sizes.addendum + lower[kind])
        else:
            above = 0.5 * (given / module - z)
            heights.append((-above if kind == 2 else above) - shift[kind])
    return heights
