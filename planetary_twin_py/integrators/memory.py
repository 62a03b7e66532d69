"""What the last passage through a contact state tells of the next.

Meshing returns to the same contacts in every cycle. In steady running the rest of the motion then
grows from the start of the step as it did the last time, so it needs no further sweep. It is a
guess: where it is wrong, the sweeps find out.
"""

from __future__ import annotations

from .._compile import kernel
from .._records import Record
from .radau import MOST

ALIKE = 0.25  # relative difference of the lengths of two steps that are compared
START = MOST  # row of what was at the start


@kernel
def recall(train: Record, march: Record) -> None:
    """Let rest and friction grow over the step as they did when it was last made."""
    run, modes = march.run, march.run.motion.modes
    known = run.known
    if not abs(known.past_step[modes] - run.motion.step) < ALIKE * run.motion.step:
        return
    for n in range(run.nodes.count):
        out = run.evaluation[n]
        for m in range(train.lanes):
            run.rest[n, m] += known.past_rest[modes, n, m] - known.past_rest[modes, START, m]
            rubbing = known.past_rubbing[modes, n, m] - known.past_rubbing[modes, START, m]
            out.rubbing[m] += rubbing


@kernel
def remember(train: Record, march: Record) -> None:
    """Keep how rest and friction grew over the first step in a contact state."""
    run, modes = march.run, march.run.motion.modes
    known = run.known
    known.past_step[modes] = run.motion.step
    for m in range(train.lanes):
        start = run.force[m] + run.damper[m] * run.p[m] + run.spring[m] * run.q[m]
        known.past_rest[modes, START, m] = start
        known.past_rubbing[modes, START, m] = march.first.rubbing[m]
    for n in range(run.nodes.count):
        for m in range(train.lanes):
            known.past_rest[modes, n, m] = run.rest[n, m]
            known.past_rubbing[modes, n, m] = run.evaluation[n].rubbing[m]
