"""How often the teeth of a part pass a mesh in a turn of the input: exact fractions."""

from __future__ import annotations

from fractions import Fraction

from ..durability.parts import part_names
from ..model.layout import Layout
from ..scene import Scene


def passages_per_turn(scene: Scene) -> dict[str, tuple[Fraction, Fraction]]:
    """Passages of each tooth in a turn of the input.

    Args:
        scene: the gearbox.

    Returns:
        By part, under positive and under negative input torque; 0 of parts without teeth.
    """
    layout, teeth = Layout(scene), scene.gearset.tooth_numbers._asdict()
    cycles, planets = abs(layout.cycles[0]), scene.gearset.planets
    torques = layout.torques
    forwards = torques[scene.drive.input.member] * torques["sun"] > 0  # drive flanks carry
    found = {}
    for part in part_names(scene):
        member, place = part.split("_")[0], part.rsplit("_", 1)[1]
        if place in ("bearing", "shaft"):
            found[part] = Fraction(0), Fraction(0)
            continue
        meshes = planets if member in ("sun", "ring") else 2 if place == "root" else 1
        each = meshes * cycles / teeth[member]
        drive = each if place != "coast" else Fraction(0)
        coast = each if place != "drive" else Fraction(0)
        found[part] = (drive, coast) if forwards else (coast, drive)
    return found
