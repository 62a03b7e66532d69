"""Check that the coupling of the second motor of a differential allows only one equilibrium.

The torque T of the second motor follows from the torque balance with friction, so it changes with
the position c in the mesh cycle and twists the coupling: the motor is at c + g T(c), where
g = z/(2 pi k), with z mesh cycles per turn of that motor and the stiffness k. If |g dT/dc| < 1, a
position of the motors determines one position of the teeth, and the iteration of
`solve_equilibrium` converges. Otherwise the teeth would jump between equilibria, which is not a
quasi-static motion.
"""

from __future__ import annotations

import math
from types import ModuleType

from ..._core import Model, State
from ...model.layout import SECOND_MOTOR

MOST_FEEDBACK = 0.5  # |g dT/dc|; the rest is for runout and faults, which change T elsewhere


def check_second_coupling(
    core: ModuleType, model: Model, tolerance: float, closing_side: int, origin: State
) -> None:
    """Refuse a coupling of the second motor that is too soft, if there is a second motor.

    Args:
        core: build of the core with the model.
        model: the train at an operating point.
        tolerance: see `solve_equilibrium`.
        closing_side: side of the teeth that carries the mean torque.
        origin: position of the motors.

    Raises:
        ValueError: it is too soft in steady running at the target speeds or at the speeds of
            `origin`; or see `solve_equilibrium`.
    """
    if model.train.axes < 2:
        return
    train = model.train
    member = train.coupling[SECOND_MOTOR, 1]
    stiffness = float(train.coupling_stiffness[SECOND_MOTOR] * train.radius[member] ** 2)
    winding = abs(float(train.cycles[1])) / (2.0 * math.pi * stiffness)
    for speed in (model.load.target_speed, origin.set_speed):
        feedback = winding * core.steepest_torque(model, tolerance, closing_side, origin, speed)
        if feedback > MOST_FEEDBACK:
            raise ValueError(
                f"drive.second_input.coupling_stiffness = {stiffness:g} N m/rad: too soft for "
                "dynamics = 'quasi_static', tooth friction winds it up so far that teeth have "
                f"several equilibria; must be at least {stiffness * feedback / MOST_FEEDBACK:.3g} "
                "N m/rad, or choose dynamics = 'torsional'"
            )
