"""A map of damage in closed form."""

import numpy as np


class PowerMap:
    """Damage of a turn is proportional to a power of the torque, for each part."""

    def __init__(self, exponents, at=100.0, per_radian=1e-9):
        self.parts = tuple(f"part_{n}" for n in range(len(exponents)))
        self._exponents, self._at, self._per_radian = np.array(exponents), at, per_radian

    def rates(self, torque, speed, temperature):
        torque, speed, _ = np.broadcast_arrays(torque, speed, temperature)
        load = (np.abs(torque) / self._at)[..., np.newaxis] ** self._exponents
        return self._per_radian * load * np.abs(speed)[..., np.newaxis]
