"""Statics of the train without loss.

Torques on sun, ring and carrier follow from the teeth: Ts : Tr : Tc = Zs : Zr : -(Zs + Zr).
"""

from __future__ import annotations

import numpy as np

from ..scene import Scene
from .bodies import MOTOR, base_radii, machines


def static_torques(scene: Scene) -> np.ndarray:
    """Torque of each machine divided by the torque of the first motor [-]."""
    parts = _parts(scene)
    members = [parts[machine.member] for machine in machines(scene).values()]
    return np.array(members) / members[MOTOR]


def mesh_force(scene: Scene, torque: float) -> float:
    """Mean force [N] of each mesh at a torque [N m] of the first motor."""
    sun_torque = torque * _parts(scene)["sun"] / _parts(scene)[scene.drive.input.member]
    return sun_torque / (base_radii(scene)["sun"] * scene.gearset.planets)


def _parts(scene: Scene) -> dict[str, int]:
    teeth = scene.gearset.tooth_numbers
    return {"sun": teeth.sun, "ring": teeth.ring, "carrier": -(teeth.sun + teeth.ring)}
