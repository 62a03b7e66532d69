"""The gearset as a URDF that turns with the published joint states.

A joint's position is the absolute angle of its body. Where a frame turns against one, that is a
`mimic`, which robot_state_publisher and RViz follow by themselves.

Tooth 0 stands at the mount angle where the position is zero: the angle of a link is the absolute
angle of its body, and the mount turns only what is seen.
"""

from __future__ import annotations

from collections.abc import Mapping
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from ..gearset.mount import mount
from ..scene.gearset import Gearset
from . import parts
from .frames import Frame, frames

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
    links = {frame.name: _turning(robot, frame) for frame in frames(gearset, base)}
    stand = mount(gearset.tooth_numbers, gearset.planet_angles)
    _visual(links["sun"], "sun", meshes, angle=stand.sun)
    _visual(links["ring"], "ring", meshes, angle=stand.ring)
    _visual(links["carrier"], "carrier", meshes)
    for frame in frames(gearset, base):
        if frame.parent == "carrier":
            _visual(links["carrier"], "pin", meshes, frame.at)
    for number, angle in enumerate(stand.planets, start=1):
        _visual(links[f"planet_{number}"], "planet", meshes, angle=angle)
    indent(robot)
    return '<?xml version="1.0"?>\n' + tostring(robot, encoding="unicode") + "\n"


def _turning(robot: Element, frame: Frame) -> Element:
    """A link that turns about z on its parent by a joint of its own, or against another joint."""
    joint = SubElement(robot, "joint", name=f"{frame.name}_joint", type="continuous")
    SubElement(joint, "parent", link=frame.parent)
    SubElement(joint, "child", link=frame.name)
    _origin(joint, frame.at)
    SubElement(joint, "axis", xyz="0 0 1")
    if frame.body != frame.name:
        followed, sign = f"{frame.body}_joint", str(frame.sign)
        SubElement(joint, "mimic", joint=followed, multiplier=sign, offset="0")
    return SubElement(robot, "link", name=frame.name)


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
