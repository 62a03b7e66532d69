"""What the meshes show between any two instants, which need not be ends of steps.

Whole steps count as `step_sums` has them. Of the first and the last only a part counts: it is read
at even times from dense output, by Simpson's rule.
"""

from __future__ import annotations

from .._compile import kernel
from .._overwrite import copy_array
from .._records import Record
from ..dynamics.equations import squeeze
from ..dynamics.mesh_force import mesh_motion, move_meshes
from ..dynamics.mesh_sums import add_sums
from .contact_sums import (
    add_films,
    add_friction,
    clear_contacts,
    find_contacts,
    put_contacts,
)
from .interpolant import interpolate
from .step_sums import FEWEST, add_look, even_intervals, set_even_times


@kernel
def count_step(model: Record, march: Record) -> None:
    """Let the last step count as far as it has not been taken: another follows."""
    sums = march.sums
    if sums.taken == 0.0:
        add_sums(sums.step, sums.total, model.train.lanes)
    else:
        _count_part(model, march, sums.taken, march.control.step)
    sums.taken = 0.0


@kernel
def count_until(model: Record, march: Record, delay: float) -> None:
    """Let the last step count up to `delay` seconds after its start."""
    _count_part(model, march, march.sums.taken, delay)
    march.sums.taken = delay


@kernel
def _count_part(model: Record, march: Record, begin: float, end: float) -> None:
    """Let the last step count from `begin` to `end` [s] after its start."""
    if end <= begin:
        return
    train, moment, sums = model.train, march.moment, march.sums
    look, work, x, v = sums.look, march.work.evaluation, march.dense.x, march.dense.v
    intervals = FEWEST
    if march.control.collocated:
        intervals = max(even_intervals(march, train.lanes, train.meshes, end - begin), FEWEST)
    set_even_times(look, begin, end, intervals)
    clear_contacts(train, sums.contacts)
    for k in range(look.count):
        interpolate(model, march, look.at[k])
        for i in range(train.meshes):
            look.d[k, i] = mesh_motion(train, i, x)
        move_meshes(train, x, v, work.now)
        squeeze(model, march.begin, moment, x, v, look.at[k], work)
        copy_array(look.push[k], work.now.push)
        find_contacts(model, moment, v, work)
        add_films(train, work.pairs, look.weight[k], sums.contacts)
        add_friction(train, work, look.weight[k], sums.contacts)
    sums.part.time = end - begin
    put_contacts(train, model.oil, sums.contacts, sums.part.integral)
    add_look(train, moment, look, sums.part)
    add_sums(sums.part, sums.total, train.lanes)
