"""How often the teeth of a part pass a mesh in a turn of the input: exact fractions."""

from __future__ import annotations

from fractions import Fraction

from ..durability import passages
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
    teeth = scene.gearset.tooth_numbers._asdict()
    counts = passages.passages_per_turn(scene, Layout(scene).cycles[0])
    return {
        part: (forwards / teeth.get(gear, 1), backwards / teeth.get(gear, 1))
        for part, (forwards, backwards) in zip(part_names(scene), counts, strict=True)
        for gear in [part.split("_")[0]]
    }
