"""Gears that creep, or come to rest as they vibrate: how their friction is integrated."""

from __future__ import annotations

from .._compile import kernel
from .._records import Record
from ..dynamics.bristles import creeps, steady_bristles
from ..dynamics.equations import forces
from .progress import DETOUR

STICKING = 0.5  # of its speed against the carrier on average, below which a gear may come to stick


@kernel
def hold_or_slide(model: Record, march: Record) -> None:
    """Let tooth pairs hold in the step that begins if the gears creep, and slide if they do not.

    Pairs that begin to hold have the friction of the traction curve, so it does not jump.
    """
    control, begin, moment = march.control, march.begin, march.moment
    creeping = creeps(model.train, moment.cycle_rate)
    if creeping == control.creeping:
        return
    control.creeping = creeping
    control.changed = True
    if creeping:
        forces(model, begin, moment, begin.x, begin.v, 0.0, begin.trim, march.first)
        steady_bristles(march.first.pairs, begin.bristle)
    march.first.pairs.held = march.last.pairs.held = creeping
    march.work.evaluation.pairs.held = creeping


@kernel
def avoid_reversals(model: Record, march: Record) -> None:
    """Leave steps to Rosenbrock's method for a while where vibration may reverse friction.

    A polynomial through friction that jumps from one sense to the other is off by more than the
    change of its nodes shows.
    """
    control, train, moment, v = march.control, model.train, march.moment, march.begin.v
    if control.creeping or not control.slow:
        return
    for i in range(train.meshes):
        carrier = train.body[i, 2]
        turning = v[carrier] * train.inverse_radius[carrier]
        for gear in range(2):
            body = train.body[i, gear]
            rigid = moment.rigid[body] - moment.rigid[carrier]
            speed = rigid + v[body] * train.inverse_radius[body] - turning
            if speed * rigid < STICKING * rigid * rigid:
                control.detour = DETOUR
                control.reversals += 1
                return
