"""Orders at which faults of a planetary gear set have lines, by its tooth numbers alone."""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple

from ...scene import Scene
from ...scene.given import check_scene
from ..gears.planet_separation import TeethSeen, teeth_seen, widest_window
from .bearing_orders import bearing_lines
from .coincidences import Coincidence, coincidences
from .fault_lines import FaultLines, central_gear_lines, planet_lines
from .shared_lines import SharedLines, shared_lines
from .turning import Turning, turning_of


class FaultOrders(NamedTuple):
    """Orders of a gear set, in cycles per turn of `reference`."""

    reference: str
    """The carrier, or the sun if the carrier is held."""
    frequency: float
    """Turns of the reference at the operating point [1/s]."""
    planets: int
    """Number of planets."""
    symmetry: int
    """Order of the rotational symmetry of the planets."""
    rates: dict[str, Fraction]
    """Orders of meshing, of members that turn and of teeth, by the keys of `units.shown.ORDERS`."""
    lines: tuple[FaultLines, ...]
    """Lines of the faults of sun, planet and ring, and of the planet bearing."""
    shared: tuple[SharedLines, ...]
    """Faults of gears with lines at the same places."""
    coincidences: tuple[Coincidence, ...]
    """Faults at one order, and faults that are close."""
    seen: dict[str, TeethSeen]
    """Teeth that a sensor sees when a planet passes it, by gear; empty if the carrier or no member
    is held."""
    widest_window: float
    """Widest window that separates planets [teeth]; 0 if the carrier or no member is held."""

    @property
    def alike(self) -> int:
        """Deprecated name of `symmetry`."""
        return self.symmetry


def fault_orders(
    scene: Scene, rollers: int | None = None, ratio: Fraction | str | None = None
) -> FaultOrders:
    """Orders at which each fault has lines, in a signal of a sensor on the housing.

    They follow from tooth numbers, held member and spacing of the planets (see `fault_lines`), for
    equal planets: errors of pins and unequal loads put lines at all sidebands.

    Args:
        scene: of the gearbox; orders of a differential are those at the ratio of its speeds at the
            operating point.
        rollers: number of rollers of a planet bearing; None leaves out the bearings.
        ratio: roller diameter over pitch diameter, times the cosine of the contact angle; a
            fraction, or text such as "0.2", which is exact.

    Returns:
        The orders as exact fractions, with the frequency of one turn.

    Raises:
        ValueError: no tooth meshes in a differential; one of `rollers` and `ratio` is missing; or
            see `bearing_lines`.
    """
    check_scene(scene)
    turning = turning_of(scene)
    lines = [central_gear_lines(turning, "sun"), planet_lines(turning)]
    lines.append(central_gear_lines(turning, "ring"))
    shared = shared_lines(turning, lines)
    if (rollers is None) != (ratio is None):
        raise ValueError(f"rollers = {rollers}, ratio = {ratio}: a bearing needs both")
    if rollers is not None and ratio is not None:
        lines += bearing_lines(turning, rollers, _fraction(ratio))
    seen, widest = dict[str, TeethSeen](), 0.0
    if turning.carrier and turning.held != "none":
        per_turn = turning.per_carrier_turn
        moving = [gear for gear in ("sun", "planet") if gear != turning.held]
        seen = {gear: teeth_seen(per_turn, getattr(turning.teeth, gear)) for gear in moving}
        widest = widest_window(per_turn, turning.planets)
    return FaultOrders(
        turning.reference,
        turning.reference_speed,
        turning.planets,
        turning.symmetry,
        _rates(turning),
        tuple(lines),
        shared,
        coincidences(turning),
        seen,
        widest,
    )


def _fraction(ratio: Fraction | str) -> Fraction:
    try:
        return Fraction(ratio)
    except (ValueError, ZeroDivisionError):
        raise ValueError(f"ratio = {ratio!r}: must be a number such as 0.2") from None


def _rates(turning: Turning) -> dict[str, Fraction]:
    """Orders by key; those of members at rest are left out."""
    sun, planet, ring = (turning.tooth(gear) for gear in ("sun", "planet", "ring"))
    count = turning.planets
    found = {
        "mesh": turning.mesh,
        "sun_turns": abs(turning.sun),
        "planet_turns": abs(turning.planet),
        "ring_turns": abs(turning.ring),
        "carrier_turns": abs(turning.carrier),
        "planets_pass": count * abs(turning.carrier),
        "sun_tooth": sun,
        "sun_tooth_all_meshes": count * sun,
        "planet_tooth": planet,
        "planet_tooth_both_meshes": 2 * planet,
        "ring_tooth": ring,
        "ring_tooth_all_meshes": count * ring,
    }
    return {name: order for name, order in found.items() if order}
