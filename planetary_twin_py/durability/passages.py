"""Passages of teeth through the meshes, counted by turns of the input of a real gearbox."""

from __future__ import annotations

import math
from fractions import Fraction
from functools import partial

import numpy as np
from numpy.typing import NDArray

from ..scene import Scene
from .parts import part_names

Counts = NDArray[np.int64]


def passages_per_turn(scene: Scene, cycles: Fraction) -> tuple[tuple[Fraction, Fraction], ...]:
    """Passages of each part in a turn of the input.

    Args:
        scene: scene of the gearbox.
        cycles: mesh cycles per turn of the input, signed.

    Returns:
        For each part, those under a positive and under a negative torque of the input. A planet
        flank meets the sun under one and the ring under the other; a root is bent by both flanks.
    """
    # Positive torque on the carrier is carried by the coast flanks of the sun.
    turned = scene.drive.input.member == "carrier"
    of_part = partial(_of_part, scene.gearset.planets, abs(cycles), turned)
    return tuple(of_part(part) for part in part_names(scene))


def _of_part(planets: int, cycles: Fraction, turned: bool, part: str) -> tuple[Fraction, Fraction]:
    gear, _, rest = part.partition("_")
    if part.endswith(("_bearing", "_shaft")):
        return Fraction(0), Fraction(0)
    if gear == "planet":
        each = 2 * cycles if part.endswith("root") else cycles
        return each, each
    each = planets * cycles
    if rest == "root":
        return each, each
    return (each, Fraction(0)) if (rest == "flank_drive") != turned else (Fraction(0), each)


def whole_passages(
    per_turn: tuple[tuple[Fraction, Fraction], ...], turns: NDArray[np.float64]
) -> Counts:
    """Whole passages of each part after some turns.

    Args:
        per_turn: see `passages_per_turn`.
        turns: of the input, under a positive and a negative torque, (2,).

    Returns:
        (parts,).
    """
    positive, negative = (Fraction(float(value)) for value in turns)
    return np.array([math.floor(p * positive + n * negative) for p, n in per_turn], dtype=np.int64)
