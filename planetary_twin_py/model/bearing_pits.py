"""Pits in the rolling bearings of a scene for the core, see `core/model/bearing_pits.hpp`."""

from __future__ import annotations

import math
from fractions import Fraction

from .._core import AXES, MovingAxes
from ..scene import Scene
from ..scene.faults import Bearing
from .bodies import Bodies
from .layout import Layout
from .rolling_bearings import element_law

LARGEST_DENOMINATOR = 2_000_000_000
"""Of turns per turn of a motor, so that products of two remain below 2^63."""


def put_pits(layout: Layout, bodies: Bodies, moving: MovingAxes) -> None:
    """Fill the pits of the bearings.

    Args:
        layout: of the scene.
        bodies: with their displacements.
        moving: to fill.
    """
    faults = _pits(layout.scene)
    moving.pits = len(faults)
    for fault, pit in zip(faults, moving.pit, strict=False):
        rolling = getattr(layout.scene.supports, fault.bearing).rolling
        name = f"planet_{fault.planet}" if fault.bearing == "planet" else fault.bearing
        pit.bearing, pit.body = layout.bearings.index(name), bodies.place[name]
        pit.roller, pit.count = fault.element == "roller", rolling.elements
        pit.exponent, pit.strength = element_law(rolling)
        pit.half_width = 0.5 * fault.width
        start = _load_direction(layout, fault) + fault.angle
        pit.start = [start, 0.0] if fault.element == "roller" else [0.0, start]
        per_turn = _per_turn(fault)
        pit.per_turn = [float(part) for part in per_turn]
        turns = [_per_motor(layout, fault, part, n) for n, part in enumerate(per_turn)]
        pit.per_motor = [[float(turn) for turn in part] for part in turns]
        rest = [[_without_whole_turns(turn) for turn in part] for part in turns]
        pit.numerator = [[turn.numerator for turn in part] for part in rest]
        pit.denominator = [[turn.denominator for turn in part] for part in rest]
    put_depths(layout.scene, moving)


def _without_whole_turns(turns: Fraction) -> Fraction:
    return turns.limit_denominator(LARGEST_DENOMINATOR) % 1


def put_depths(scene: Scene, moving: MovingAxes) -> None:
    """Fill the depths of the pits, which may change while a run goes on."""
    for fault, pit in zip(_pits(scene), moving.pit, strict=False):
        pit.depth = fault.depth


def _pits(scene: Scene) -> list[Bearing]:
    return [fault for fault in scene.faults if isinstance(fault, Bearing)]


def _load_direction(layout: Layout, fault: Bearing) -> float:
    """Angle of the most loaded element: the meshes press a planet across its radius."""
    if fault.bearing != "planet":
        return 0.0
    force = layout.mesh_force(layout.scene.operating_point.input_torque)
    return -0.5 * math.pi if force >= 0.0 else 0.5 * math.pi


def _per_turn(fault: Bearing) -> tuple[Fraction, Fraction]:
    """Turns of the cage, and of the race or the roller with the pit, per turn of the body."""
    ratio = Fraction(str(fault.ratio))
    if fault.bearing == "planet":
        cage, races = (1 + ratio) / 2, {"inner": Fraction(0), "outer": Fraction(1)}
    else:
        cage, races = (1 - ratio) / 2, {"inner": Fraction(1), "outer": Fraction(0)}
    return cage, races.get(fault.element, (1 - ratio**2) / (2 * ratio))


def _per_motor(layout: Layout, fault: Bearing, part: Fraction, number: int) -> list[Fraction]:
    """Turns per turn of each motor, in the frame of the displacements, which turns as the carrier.

    The turn of a roller is that against its cage.
    """
    turns = [Fraction(0)] * AXES
    carried = fault.bearing == "planet"
    fixed = carried or (number == 1 and fault.element == "roller")
    of_body, of_carrier = layout.ratios[fault.bearing], layout.ratios["carrier"]
    for a, (body, carrier) in enumerate(zip(of_body, of_carrier, strict=True)):
        relative = body - carrier if carried else body
        turns[a] = part * relative - (0 if fixed else carrier)
    return turns
