"""A step by collocation: how long it is, and where it ends.

It ends exactly on the edge of a tooth pair, or where a flank meets or parts: its motion is known
at any time within it.
"""

from __future__ import annotations

import math

from .._compile import kernel
from .._overwrite import copy_array, overwrite
from .._records import Record
from ..dynamics.equations import drive, squeeze
from ..dynamics.mesh_force import move_meshes
from .collocation import collocate
from .edges import planned, time_to_edge
from .flanks import at_event, first_flank_event
from .frame import pass_time
from .memory import remember
from .progress import COLLOCATION, DETOUR, GROW, NO_MESH, SAFETY, SHORTEST_STEP, SHRINK
from .propagation import enter, integrate_powers, propagate, resolves, trim_at

FAILED = -2  # no mesh, and no step
ON_EDGE = 1e-13  # [s] to which a step ends on the edge of a tooth pair
WITHIN = 0.1  # of the step, by which its end is moved for that at most
STRETCH = 1.2  # by which a planned step is stretched to end on an event
OUTDONE = 0.2  # of the other method's step, below which it is taken


@kernel
def collocated_step(model: Record, march: Record, longest: float, event: float, mesh: int) -> int:
    """A step by collocation, at whose end `mesh` may come to an edge.

    Returns:
        The mesh whose flanks meet or part at its end, NO_MESH, or FAILED.
    """
    control, run, order = march.control, march.run, march.run.nodes.count
    hold_friction(model, march)
    enter(model, march)
    # Meshing returns to the same contacts: the step that did then, will do.
    known, modes, fresh = run.known, run.motion.modes, control.changed
    h = known.step[modes] if fresh and known.step[modes] > 0.0 else control.next_step
    h = min(planned(event, min(h, longest), STRETCH), longest)
    restless = 0
    while True:
        if control.method != COLLOCATION and not resolves(run, model.train.bodies, h):
            return FAILED
        error, settled = collocate(model, march, h, fresh)
        if error <= 1.0 or (h <= SHORTEST_STEP and error < math.inf):
            break
        restless += 0 if settled else 1
        shorter = h * max(SHRINK, SAFETY * error ** (-1.0 / order))
        if h <= SHORTEST_STEP or _outdone(control, shorter, settled, restless):
            return FAILED
        control.rejected += 1
        h = max(shorter, SHORTEST_STEP)
    factor = SAFETY * error ** (-1.0 / order) if error > 0.0 else GROW
    control.next_step = h * min(GROW, max(SHRINK, factor))
    if fresh:
        known.step[modes] = control.next_step
        remember(model.train, march)
    if h < min(event, longest) and _outdone(control, h, True, 0):
        control.detour = DETOUR
    control.collocated = True
    control.changed = False
    end_within(model, march, h)
    if mesh != NO_MESH and h == event:
        _meet_edge(model, march, mesh, h)
    copy_array(march.last.power, run.evaluation[order - 1].power)
    copy_array(march.last.rubbing, run.evaluation[order - 1].rubbing)
    return _end_on_flank_event(model, march, h)


@kernel
def _outdone(control: Record, h: float, settled: bool, restless: int) -> bool:
    """Whether Rosenbrock's method is to be taken rather than collocation over h seconds."""
    if control.method == COLLOCATION:
        return False
    if not settled and (restless > 1 or h < control.next_stiff):
        return True
    return h < (1.0 if control.slow else OUTDONE) * control.next_stiff


@kernel
def hold_friction(model: Record, march: Record) -> None:
    """Forces at the start of a step, but with the friction of the end of the last."""
    begin, moment, first = march.begin, march.moment, march.first
    move_meshes(model.train, begin.x, begin.v, first.now)
    squeeze(model, begin, moment, begin.x, begin.v, 0.0, first)
    copy_array(first.rubbing, march.last.rubbing)
    drive(model, begin, moment, begin.x, begin.v, 0.0, begin.trim, first)


@kernel
def end_within(model: Record, march: Record, h: float) -> None:
    """Let the step of collocation end after h seconds, on its own motion."""
    begin, end = march.begin, march.end
    overwrite(end, begin)
    if h == march.run.motion.step:
        last = march.run.nodes.count - 1
        copy_array(end.x, march.run.node_x[last])
        copy_array(end.v, march.run.node_v[last])
        copy_array(end.trim, march.run.node_trim[last])
    else:
        propagate(model, march, h, end.x, end.v)
        trim_at(model, march, h, end.x, end.trim)
    integrate_powers(march, model.train.lanes, h)
    pass_time(model, march, h)


@kernel
def _meet_edge(model: Record, march: Record, mesh: int, h: float) -> None:
    """Move the end of the step to where `mesh` comes to the edge of its segment (Newton).

    Where the pace has changed too much for that, the next steps come to the edge.
    """
    for _ in range(3):
        gap = time_to_edge(model, march, mesh)
        if abs(gap) < ON_EDGE or not abs(gap) < WITHIN * h:
            return
        h += gap
        end_within(model, march, h)


@kernel
def _end_on_flank_event(model: Record, march: Record, h: float) -> int:
    """Let the step end where a mesh changes its contact first; that mesh, or NO_MESH."""
    mesh, when = first_flank_event(model, march)
    if mesh != NO_MESH and h > SHORTEST_STEP and not at_event(model, march, mesh):
        end_within(model, march, when)
    return mesh
