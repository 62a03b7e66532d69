"""URDF of the gearset, for the published joint states.

The position of a joint is the absolute angle of its body. Frames that rotate against a body are
`mimic` joints, which robot_state_publisher and RViz support.

At position zero, tooth 0 is at the mount angle: the mount rotates only the visual shapes.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from ..scene.gearset import Gearset
from ..scene.sensors import AnySensor
from . import parts, shapes
from .frames import Frame, frames

_COLOURS = {
    "sun": parts.SUN,
    "planet": parts.PLANET,
    "ring": parts.RING,
    "carrier": parts.CARRIER,
    "pin": parts.PIN,
    "mark": parts.MARK,
}


def robot_description(
    gearset: Gearset, base: str = "gearbox", sensors: Sequence[AnySensor] = ()
) -> str:
    """URDF of a gearset, made of boxes and cylinders, without references to files.

    Args:
        gearset: to describe; lengths in m.
        base: name of the root link.
        sensors: those with an angle on the housing have fixed links.

    Returns:
        URDF text with the joints `sun_joint`, `planet_1_joint`, ..., `ring_joint`, `carrier_joint`.
    """
    robot = Element("robot", name="planetary_twin")
    for name, colour in _COLOURS.items():
        rgba = " ".join(f"{channel / 255:.3f}" for channel in colour)
        SubElement(SubElement(robot, "material", name=name), "color", rgba=f"{rgba} 1")
    SubElement(robot, "link", name=base)
    all_frames = frames(gearset, base, sensors)
    links = {frame.name: _turning(robot, frame) for frame in all_frames}
    stand = gearset.mounted
    _add_visuals(links["sun"], shapes.wheel(gearset, "sun", stand.sun))
    _add_visuals(links["ring"], shapes.ring(gearset, stand.ring))
    _add_visuals(links["carrier"], shapes.carrier(gearset))
    for number, angle in enumerate(stand.planets, start=1):
        wheel = shapes.wheel(gearset, "planet", angle)
        _add_visuals(links[f"planet_{number}"], wheel)
    for frame in all_frames:
        if not frame.sign:
            _add_visuals(links[frame.name], shapes.sensor(gearset))
    indent(robot, space="")
    return '<?xml version="1.0"?>\n' + tostring(robot, encoding="unicode") + "\n"


def _turning(robot: Element, frame: Frame) -> Element:
    """Add a link that rotates about z in its parent, by its own joint or as a mimic joint.

    That of a fixed frame does not rotate.
    """
    kind = "continuous" if frame.sign else "fixed"
    joint = SubElement(robot, "joint", name=f"{frame.name}_joint", type=kind)
    SubElement(joint, "parent", link=frame.parent)
    SubElement(joint, "child", link=frame.name)
    x, y = frame.at
    SubElement(joint, "origin", xyz=f"{x:.12g} {y:.12g} 0", rpy=f"0 0 {frame.turned:.12g}")
    if not frame.sign:
        return SubElement(robot, "link", name=frame.name)
    SubElement(joint, "axis", xyz="0 0 1")
    if frame.body != frame.name:
        followed, sign = f"{frame.body}_joint", str(frame.sign)
        SubElement(joint, "mimic", joint=followed, multiplier=sign, offset="0")
    return SubElement(robot, "link", name=frame.name)


def _add_visuals(link: Element, seen: Iterable[shapes.Shape]) -> None:
    """Add visual shapes to a link; six digits are far below the resolution of a screen."""
    for shape in seen:
        visual = SubElement(link, "visual")
        SubElement(visual, "origin", xyz=_numbers(shape.at), rpy=f"0 0 {shape.angle:.6g}")
        geometry = SubElement(visual, "geometry")
        if len(shape.size) == 3:
            SubElement(geometry, "box", size=_numbers(shape.size))
        else:
            radius, length = shape.size
            SubElement(geometry, "cylinder", radius=f"{radius:.6g}", length=f"{length:.6g}")
        SubElement(visual, "material", name=shape.material)


def _numbers(lengths: Iterable[float]) -> str:
    return " ".join(f"{length:.6g}" for length in lengths)
