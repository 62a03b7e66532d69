"""A mode of vibration, by its response over frequency."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Mode(NamedTuple):
    """A mass on a spring with a damper."""

    frequency: float
    """Natural frequency [rad/s]."""
    damping_ratio: float

    @property
    def decay(self) -> float:
        """Time constant of free vibration [s]."""
        return 1.0 / (self.damping_ratio * self.frequency)

    def displacement(self, omega: NDArray[np.float64]) -> NDArray[np.complex128]:
        """Displacement over that at rest under a force with angular frequency omega [rad/s], (n,).

        It is also what an accelerometer on this mode shows over the acceleration of its base.
        """
        x = omega / self.frequency
        return np.asarray(1.0 / (1.0 - x**2 + 2j * self.damping_ratio * x))

    def acceleration(self, omega: NDArray[np.float64]) -> NDArray[np.complex128]:
        """Acceleration over the force per mass, (n,)."""
        return -((omega / self.frequency) ** 2) * self.displacement(omega)
