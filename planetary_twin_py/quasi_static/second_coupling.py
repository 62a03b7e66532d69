"""Whether the coupling of a differential's second motor is stiff enough for one equilibrium.

The second motor gives what friction leaves to be given, so its torque T changes with the place c
in the mesh cycle and winds up its coupling: the motor stands at c + g T(c), g = z/(2 pi k), with z
mesh cycles per turn of that motor and k the stiffness. Only where |g dT/dc| < 1 does a position of
the motors belong to one place of the teeth, and only there does each pass of `settle` come closer
to it. Beyond, teeth would jump between equilibria, which is no quasi-static motion.
"""

from __future__ import annotations

import math

import numpy as np

from .._records import Record
from ..dynamics.bodies import SECOND_MOTOR
from ..dynamics.moment import frame_cycle_rate
from ..dynamics.observe import QUANTITIES
from .equilibrium import first_guess, settle
from .motion import turn_to

PLACES = 256  # of a mesh cycle; a jump of the torque counts as a slope from one to the next
MOST_FEEDBACK = 0.5  # |g dT/dc|; the rest is for runout and faults, which change T elsewhere
RIGID = 1e9  # times the stiffness: a coupling that friction does not wind


def check_second_coupling(model: Record, tolerance: float, lean: int, origin: Record) -> None:
    """Refuse a coupling of the second motor, if there is one, that is too soft.

    Args:
        model: the train at an operating point.
        tolerance: see `settle`.
        lean: side of the teeth on which the mean torque presses.
        origin: a STATE: where the motors are.

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
        feedback = winding * _steepest(model, tolerance, lean, origin, speed)
        if feedback > MOST_FEEDBACK:
            raise ValueError(
                f"drive.second_input.coupling_stiffness = {stiffness:g} N m/rad: too soft for "
                "dynamics = 'quasi_static', tooth friction winds it up so far that teeth have "
                f"several equilibria; must be at least {stiffness * feedback / MOST_FEEDBACK:.3g} "
                "N m/rad, or choose dynamics = 'torsional'"
            )


def _steepest(
    model: Record, tolerance: float, lean: int, origin: Record, speed: np.ndarray
) -> float:
    """Largest change of the second motor's torque per mesh cycle [N m] at constant `speed`."""
    rigid, begin = model.copy(), origin.copy()
    rigid.train.coupling_stiffness[SECOND_MOTOR] *= RIGID
    rigid.load.target_speed = speed
    begin.set_speed = begin.speed = speed
    rate = abs(float(frame_cycle_rate(rigid.train, begin)))
    if rate == 0.0:
        return 0.0
    run, shown = first_guess(lean), np.zeros((QUANTITIES, int(model.train.meshes)))
    torque = np.empty(PLACES + 1)
    for n in range(PLACES + 1):
        turn_to(rigid, begin, n / (PLACES * rate), run.state)
        settle(rigid, tolerance, run, shown)
        torque[n] = run.torque[SECOND_MOTOR]
    return float(np.abs(np.diff(torque)).max()) * PLACES
