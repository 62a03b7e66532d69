"""Damage of shafts by the course of the torque over a duty, counted as rainflow cycles."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ..durability.parts import SHAFTS, part_names
from ..durability.rainflow import Rainflow
from ..model.layout import LOAD_MACHINE, Layout
from ..scene import Scene
from .duty_table import Duty

Array = NDArray[np.float64]


def shaft_damage(scene: Scene, duty: Duty) -> tuple[Array, tuple[str, ...]]:
    """Damage of the cycles from row to row, if the duty is repeated for ever.

    Args:
        scene: the gearbox.
        duty: the duty.

    Returns:
        Miner sums of one repetition, 0 of other parts than shafts, (parts,); and a line if there
        are shafts and the duty has no order.
    """
    parts = part_names(scene)
    found = np.zeros(len(parts))
    assert scene.durability is not None
    rated = {
        f"{side}_shaft": getattr(scene.durability.shafts, side)
        for side in SHAFTS
        if getattr(scene.durability.shafts, side) is not None
    }
    if rated and duty.time is None:
        return found, (
            "a duty without the column time has no cycles of torque: shafts have the damage of "
            "vibration alone",
        )
    ratio = abs(float(Layout(scene).machine_torques[LOAD_MACHINE]))
    for part, shaft in rated.items():
        history = Rainflow()
        history.feed(duty.columns["input_torque"] * (1.0 if part == "input_shaft" else ratio))
        cycles = history.repeated
        damage = cycles.counts * (cycles.ranges / shaft.range) ** shaft.exponent
        found[parts.index(part)] = math.fsum(damage) / shaft.reference_cycles
    return found, ()
