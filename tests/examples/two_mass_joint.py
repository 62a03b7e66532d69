"""Two masses with play between them under a sampled controller: a joint by textbook equations.

The motor with its gears, carried to the output, and the link are coupled by a spring and a damper
behind a dead zone (Nordin and Gutman 2002, Automatica 38, 1633, eqs. 1 and 3; they can only push).
Classical Runge-Kutta steps, far below the period of the spring.
"""

from dataclasses import dataclass

import numpy as np

SUBSTEPS = 25  # of a period of the controller


@dataclass(frozen=True)
class TwoMasses:
    motor: float  # inertia at the output [kg m^2]
    link: float  # [kg m^2]
    half_play: float  # [rad]
    stiffness: float  # [N m/rad]
    damping: float  # [N m s/rad]

    def rate(self, y, torque):
        """Of angle and speed of the motor, and of the link."""
        twist = y[0] - y[2]
        beyond = np.sign(twist) * max(abs(twist) - self.half_play, 0.0)
        through = self.stiffness * beyond + self.damping * (y[1] - y[3]) if beyond else 0.0
        if through * beyond < 0.0:
            through = 0.0
        return np.array([y[1], (torque - through) / self.motor, y[3], through / self.link])

    def course(self, controller, period, count):
        """Angles of the link after each of so many periods of the controller."""
        y, angles, h = np.zeros(4), [], period / SUBSTEPS
        for _ in range(count):
            torque = controller(y[2], y[1])
            for _ in range(SUBSTEPS):
                a = self.rate(y, torque)
                b = self.rate(y + 0.5 * h * a, torque)
                c = self.rate(y + 0.5 * h * b, torque)
                d = self.rate(y + h * c, torque)
                y = y + h / 6.0 * (a + 2.0 * b + 2.0 * c + d)
            angles.append(y[2])
        return np.array(angles)
