"""A map of damage with a closed form: powers of the torque, times the speed."""

import numpy as np

import planetary_twin_py as pt
from planetary_twin_py.durability.parts import part_names

SCENE = pt.load_scene("paper").replace(
    durability={"bearings": {"planet": {"rating": 20e3, "kind": "roller"}}}
)
PARTS = part_names(SCENE)
EXPONENTS = np.linspace(3.0, 9.0, len(PARTS))
NOMINAL, MOST = 63.0, 100.0  # [N m]
PER_RADIAN = 1e-9


class PowerMap:
    """Rates of the parts of `SCENE`."""

    parts = PARTS

    def __init__(self):
        self.asked = 0

    def outside(self, torque, speed, temperature):
        torque, *_ = np.broadcast_arrays(torque, speed, temperature)
        return np.abs(torque) > MOST

    def rates(self, torque, speed, temperature):
        torque, speed, _ = np.broadcast_arrays(torque, speed, temperature)
        self.asked += torque.size
        return expected_rates(torque, speed)


def expected_rates(torque, speed):
    """Rates of all parts [1/s], (..., parts)."""
    share = np.abs(np.asarray(torque, float))[..., None] / NOMINAL
    return PER_RADIAN * share**EXPONENTS * np.abs(np.asarray(speed, float))[..., None]
