"""Statics of the train without loss.

Torques on sun, ring and carrier follow from the teeth: Ts : Tr : Tc = Zs : Zr : -(Zs + Zr).
"""

from __future__ import annotations

import numpy as np

from ..scene import Scene
from .bodies import MOTOR, base_radii, machines


def static_torques(scene: Scene) -> np.ndarray:
    """Torque of each machine divided by the torque of the first motor [-]."""
    found = parts(scene)
    members = [found[machine.member] for machine in machines(scene).values()]
    return np.array(members) / members[MOTOR]


def mesh_force(scene: Scene, torque: float) -> float:
    """Mean force [N] of each mesh at a torque [N m] of the first motor."""
    sun_torque = torque * parts(scene)["sun"] / parts(scene)[scene.drive.input.member]
    return sun_torque / (base_radii(scene)["sun"] * scene.gearset.planets)


def parts(scene: Scene) -> dict[str, int]:
    """Torques of sun, ring and carrier in proportion, as numbers of teeth."""
    teeth = scene.gearset.tooth_numbers
    return {"sun": teeth.sun, "ring": teeth.ring, "carrier": -(teeth.sun + teeth.ring)}
