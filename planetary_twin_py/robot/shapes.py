"""The parts of a gearset as boxes and cylinders, the primitive shapes of URDF.

Every tool that reads URDF draws these on any machine; meshes would need separate files.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..gearset.involute import SpurGear
from ..scene.gearset import Gearset
from .parts import arm_width, carrier_radius, hub_radius, pin_radius, plate, rim

Point = tuple[float, float, float]


class Shape(NamedTuple):
    """A box of `size` (x, y, z) [m], or a cylinder of `size` (radius, length) [m] about z.

    Its position is `at` [m] in the frame of its part, rotated by `angle` [rad] about z; `material`
    is the name of its colour.
    """

    size: tuple[float, ...]
    material: str
    at: Point = (0.0, 0.0, 0.0)
    angle: float = 0.0


def wheel(gearset: Gearset, part: str, mount: float) -> list[Shape]:
    """An external gear: a disc up to the root circle, and its teeth.

    Args:
        gearset: gives the gear and its face width.
        part: "sun" or "planet", also the name of the colour.
        mount: direction of tooth 0 [rad].

    Returns:
        The shapes.
    """
    gear: SpurGear = getattr(gearset.geometry, part)
    disc = Shape((gear.root_radius, gearset.face_width), part)
    return [disc, *_around(_tooth(gear, gearset.face_width, part), round(gear.teeth), mount)]


def sensor(gearset: Gearset) -> list[Shape]:
    """A sensor on the housing: a box outwards from its frame.

    Args:
        gearset: gives the size.
    """
    side = 0.12 * rim(gearset.geometry.ring)
    return [Shape((side, side, side), "mark", (0.5 * side, 0.0, 0.0))]


def ring(gearset: Gearset, mount: float) -> list[Shape]:
    """The ring: teeth inside a rim of flat pieces, one behind each tooth; `mount` as in `wheel`.

    Args:
        gearset: the gears.
        mount: direction of tooth 0 [rad].
    """
    teeth, width = gearset.teeth.ring, gearset.face_width
    gear = gearset.geometry.ring
    inner, outer = gear.root_radius, rim(gear)
    length = 2.0 * outer * math.tan(math.pi / teeth)
    piece = Shape((outer - inner, length, width), "ring", (0.5 * (inner + outer), 0.0, 0.0))
    return _around([*_tooth(gear, width, "ring"), piece], teeth, mount)


def carrier(gearset: Gearset) -> list[Shape]:
    """The carrier behind the gears: a hub, and per planet an arm with a round end and a pin.

    Args:
        gearset: the gears.
    """
    reach, width = carrier_radius(gearset), arm_width(gearset)
    low, high = plate(gearset)
    middle, thick = 0.5 * (low + high), high - low
    shapes = [Shape((hub_radius(gearset), thick), "carrier", (0.0, 0.0, middle))]
    for psi in gearset.planet_angles:
        x, y = reach * math.cos(psi), reach * math.sin(psi)
        length = 1.26 * gearset.face_width
        shapes += [
            Shape((reach, 2.0 * width, thick), "carrier", (0.5 * x, 0.5 * y, middle), psi),
            Shape((width, thick), "carrier", (x, y, middle)),
            Shape((pin_radius(gearset), length), "pin", (x, y, -0.07 * gearset.face_width)),
        ]
    return shapes


def _tooth(gear: SpurGear, width: float, part: str) -> list[Shape]:
    """A trapezium in place of a tooth at angle zero: two flank boxes and a middle box.

    Its sides cut the involutes at 15 % of the height from foot and tip, so that they are within
    0.15 modules of teeth of usual proportions. A flank box is thick enough to touch the middle box
    at the wider end of the tooth, where the gap is largest.
    """
    foot, tip = gear.root_radius, gear.tip_radius
    radii = np.array([foot + 0.15 * (tip - foot), tip - 0.15 * (tip - foot)])
    half = gear.half_thickness(radii)
    x, y = radii * np.cos(half), radii * np.sin(half)
    slope = float((y[1] - y[0]) / (x[1] - x[0]))
    foot_y, tip_y = (float(y[0] + slope * (end - x[0])) for end in (foot, tip))
    # Straight sides of a nearly pointed tooth would intersect below its tip.
    tip_y = max(tip_y, tip * math.sin(gear.half_thickness(np.array(tip))))
    height = abs(tip - foot)
    flank = math.hypot(height, foot_y - tip_y)
    thick = abs(foot_y - tip_y) * height / flank
    lean = math.atan2(tip_y - foot_y, tip - foot)
    centre = complex(0.5 * (foot + tip), 0.5 * (foot_y + tip_y))
    # Inwards from the upper flank: towards negative y.
    inwards = math.copysign(0.5 * thick, foot - tip) * 1j * complex(math.cos(lean), math.sin(lean))
    at = centre + inwards
    upper = Shape((flank, thick, width), part, (at.real, at.imag, 0.0), lean)
    lower = upper._replace(at=(at.real, -at.imag, 0.0), angle=-lean)
    middle = Shape((height, 2.0 * min(foot_y, tip_y), width), part, (centre.real, 0.0, 0.0))
    return [middle, upper, lower]


def _around(shapes: list[Shape], teeth: int, mount: float) -> list[Shape]:
    """`shapes` once per tooth, tooth 0 at `mount` [rad] and in the colour of the mark."""
    turned = []
    for tooth in range(teeth):
        angle = mount + 2.0 * math.pi * tooth / teeth
        for shape in shapes if tooth else [shape._replace(material="mark") for shape in shapes]:
            x, y, z = shape.at
            at = complex(x, y) * complex(math.cos(angle), math.sin(angle))
            turned.append(shape._replace(at=(at.real, at.imag, z), angle=shape.angle + angle))
    return turned
