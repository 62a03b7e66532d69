"""Summary of a scene in customary units, in which a wrong unit is easy to notice."""

from __future__ import annotations

from collections.abc import Iterator

from ..units.conversion import customary
from ..units.engineering import figure
from .scene import Scene


def gears(scene: Scene) -> Iterator[str]:
    """Main dimensions of the gears, each with its unit."""
    gearset = scene.gearset
    teeth = gearset.teeth
    yield f"{teeth.sun}/{teeth.planet}/{teeth.ring} teeth"
    plane = "" if gearset.normal_module is None else "normal "
    module, angle = gearset.module_and_angle
    yield f"{plane}module {customary(module, 'm')}"
    shift, gears = gearset.profile_shift, gearset.geometry
    if shift.sun or shift.planet or shift.ring:
        yield f"profile shift {shift.sun:g}/{shift.planet:g}/{shift.ring:g}"
    if gears.centre_distance != gears.meshes[0].reference_distance:
        yield f"centre distance {customary(gears.centre_distance, 'm')}"
    yield f"face width {customary(gearset.face_width, 'm')}"
    yield f"{plane}pressure angle {customary(angle, 'rad')}"
    if gearset.helix_angle:
        yield f"helix angle {customary(gearset.helix_angle, 'rad')}"
    for number, angle in enumerate(gearset.planet_angles, 1):
        yield f"planet {number} at {customary(angle, 'rad')}"
    yield "differential" if gearset.held == "none" else f"{gearset.held} fixed"


def power_enters_at_output(scene: Scene) -> bool:
    """Whether the signs of torque and speed make the output drive.

    Not where there are two inputs, or torque or motion are given at a port.
    """
    point, drive = scene.operating_point, scene.drive
    if drive.second_input is not None or drive.ports.given:
        return False
    return point.input_torque * point.input_speed < 0.0


def operating_point(scene: Scene) -> Iterator[str]:
    """Set-points of a scene, each with its unit."""
    point = scene.operating_point
    yield f"input speed {customary(point.input_speed, 'rad/s')}"
    if scene.drive.second_input is not None:
        yield f"second input speed {customary(point.second_input_speed, 'rad/s')}"
    yield f"input torque {figure(point.input_torque, 'N m')}"
    if power_enters_at_output(scene):
        yield f"power enters at the output, the {scene.drive.output.member}"
    yield f"backlash {customary(point.backlash, 'm')}"
    yield f"oil {customary(point.oil_temperature, 'K')}"
