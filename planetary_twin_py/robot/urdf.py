"""The gearset as a URDF that turns with the published joint states.

A joint's position is the absolute angle of its body, as everywhere in this project. Sun, ring and
carrier therefore hang on the base. A planet is carried round, yet must not be turned, by the
carrier: it hangs on a frame `planet_i_centre` that stands on the carrier and turns back by the
carrier's angle (`mimic`). This holds whichever member is held, and nothing but the absolute
angles is needed: robot_state_publisher and RViz follow `mimic` by themselves.

Tooth 0 stands at the mount angle where the position is zero: the angle of a link is the absolute
angle of its body, and the mount turns only what is seen.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from ..gearset.mount import mount
from ..scene.gearset import Gearset
from . import parts

_COLOURS = {
    "sun": parts.SUN,
    "planet": parts.PLANET,
    "ring": parts.RING,
    "carrier": parts.CARRIER,
    "pin": parts.PIN,
}


def urdf(gearset: Gearset, base: str, meshes: Mapping[str, str]) -> str:
    """URDF text with root link `base`; `meshes` gives each part's mesh as a URI.

    Joints are `sun_joint`, `planet_1_joint`, ..., `ring_joint`, `carrier_joint`; lengths [m].
    """
    robot = Element("robot", name="planetary_twin")
    for name, colour in _COLOURS.items():
        rgba = " ".join(f"{channel / 255:.3f}" for channel in colour)
        SubElement(SubElement(robot, "material", name=name), "color", rgba=f"{rgba} 1")
    SubElement(robot, "link", name=base)
    stand = mount(gearset.tooth_numbers, gearset.planet_angles)
    _visual(_turning(robot, "sun", base), "sun", meshes, angle=stand.sun)
    _visual(_turning(robot, "ring", base), "ring", meshes, angle=stand.ring)
    carrier = _turning(robot, "carrier", base)
    _visual(carrier, "carrier", meshes)
    radius = parts.carrier_radius(gearset)
    for number, (psi, angle) in enumerate(
        zip(gearset.planet_angles, stand.planets, strict=True), start=1
    ):
        at = (radius * math.cos(psi), radius * math.sin(psi))
        _visual(carrier, "pin", meshes, at)
        centre, planet = f"planet_{number}_centre", f"planet_{number}"
        _turning(robot, centre, "carrier", at, against="carrier_joint")
        _visual(_turning(robot, planet, centre), "planet", meshes, angle=angle)
    indent(robot)
    return '<?xml version="1.0"?>\n' + tostring(robot, encoding="unicode") + "\n"


def _turning(
    robot: Element,
    name: str,
    parent: str,
    at: tuple[float, float] = (0.0, 0.0),
    against: str | None = None,
) -> Element:
    """A link that turns about z on `parent` by a joint of its own, or against another joint."""
    joint = SubElement(robot, "joint", name=f"{name}_joint", type="continuous")
    SubElement(joint, "parent", link=parent)
    SubElement(joint, "child", link=name)
    _origin(joint, at)
    SubElement(joint, "axis", xyz="0 0 1")
    if against is not None:
        SubElement(joint, "mimic", joint=against, multiplier="-1", offset="0")
    return SubElement(robot, "link", name=name)


def _visual(
    link: Element,
    part: str,
    meshes: Mapping[str, str],
    at: tuple[float, float] = (0.0, 0.0),
    angle: float = 0.0,
) -> None:
    visual = SubElement(link, "visual")
    _origin(visual, at, angle)
    SubElement(SubElement(visual, "geometry"), "mesh", filename=meshes[part])
    SubElement(visual, "material", name=part)


def _origin(element: Element, at: tuple[float, float], angle: float = 0.0) -> None:
    SubElement(element, "origin", xyz=f"{at[0]:.12g} {at[1]:.12g} 0", rpy=f"0 0 {angle:.12g}")
