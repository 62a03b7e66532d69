"""Where gears begin and cease to creep: tooth pairs begin to hold, and let go."""

from __future__ import annotations

from .._compile import kernel
from .._records import Record
from ..dynamics.bristles import creeps, steady_bristles
from ..dynamics.equations import forces


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
