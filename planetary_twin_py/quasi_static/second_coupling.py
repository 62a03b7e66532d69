"""Whether the coupling of a differential's second motor is stiff enough for one equilibrium.

The second motor gives what friction leaves to be given, so its torque T changes with the place c
in the mesh cycle and winds up its coupling: the motor stands at c + g T(c), g = z/(2 pi k), with z
mesh cycles per turn of that motor and k the stiffness. Only where |g dT/dc| < 1 does a position of
the motors belong to one place of the teeth, and only there does each pass of `settle` come closer
to it. Beyond, teeth would jump between equilibria, which is no quasi-static motion.
"""

from __future__ import annotations

import math

from .._core import Model, State, steepest_torque
from ..dynamics.bodies import SECOND_MOTOR

MOST_FEEDBACK = 0.5  # |g dT/dc|; the rest is for runout and faults, which change T elsewhere


def check_second_coupling(model: Model, tolerance: float, lean: int, origin: State) -> None:
    """Refuse a coupling of the second motor, if there is one, that is too soft.

    Args:
        model: the train at an operating point.
        tolerance: see `settle`.
        lean: side of the teeth on which the mean torque presses.
        origin: where the motors are.

    Raises:
        ValueError: it is too soft in steady running at the speeds that are wanted, or at those of
            `origin`; or see `settle`.
    """
    if model.train.axes < 2:
        return
    train = model.train
    member = train.coupling[SECOND_MOTOR, 1]
    stiffness = float(train.coupling_stiffness[SECOND_MOTOR] * train.radius[member] ** 2)
    winding = abs(float(train.cycles[1])) / (2.0 * math.pi * stiffness)
    for speed in (model.load.target_speed, origin.set_speed):
        feedback = winding * steepest_torque(model, tolerance, lean, origin, speed)
        if feedback > MOST_FEEDBACK:
            raise ValueError(
                f"drive.second_input.coupling_stiffness = {stiffness:g} N m/rad: too soft for "
                "dynamics = 'quasi_static', tooth friction winds it up so far that teeth have "
                f"several equilibria; must be at least {stiffness * feedback / MOST_FEEDBACK:.3g} "
                "N m/rad, or choose dynamics = 'torsional'"
            )
