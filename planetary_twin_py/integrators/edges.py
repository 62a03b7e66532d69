"""Tooth pairs that enter and leave: when they will, and that they have.

They do so on the edges of the segments of the mesh cycle, see `mesh.tooth_pairs`.
"""

from __future__ import annotations

import math

from .._compile import kernel
from .._records import Record
from ..dynamics.contact_events import change_segment
from ..dynamics.cycle import cycle_shift, mesh_cycle, nearest_to_segment
from ..dynamics.state import OPEN
from .progress import NO_MESH, SHORTEST_STEP

EDGE = 1e-9  # [-] mesh cycles within which a tooth pair counts as having entered or left


@kernel
def next_event(model: Record, march: Record) -> tuple[float, int]:
    """Time [s] to the next tooth pair event or change of the set-point's slope, and the mesh."""
    train, state, moment = model.train, march.begin, march.moment
    pace = moment.cycle_rate + cycle_shift(train, state.v)
    nearest, mesh = math.inf, NO_MESH
    for i in range(train.meshes):
        if state.side[i] == OPEN:
            continue
        rate = state.side[i] * pace
        kind, segment = train.kind[i], state.segment[i]
        if rate > 0.0:
            time = (train.edge[kind, segment + 1] - moment.start[i]) / rate
        elif rate < 0.0:
            time = (train.edge[kind, segment] - moment.start[i]) / rate
        else:
            continue
        if time < nearest:
            nearest, mesh = time, i
    for a in range(train.axes):
        if moment.slew[a] != 0.0:
            gap = model.load.target_speed[a] - state.set_speed[a]
            if gap / moment.slew[a] < nearest:
                nearest, mesh = gap / moment.slew[a], NO_MESH
    return max(nearest, SHORTEST_STEP), mesh


@kernel
def planned(event: float, h: float, stretch: float) -> float:
    """A step of about h that does not leave a tiny one before the event."""
    if event <= stretch * h:
        return event
    return 0.5 * event if event < 2.0 * h else h


@kernel
def time_to_edge(model: Record, march: Record, i: int) -> float:
    """Time [s] by which mesh i is short of the edge of its segment at the end of the step."""
    train, begin, end, moment = model.train, march.begin, march.end, march.moment
    advance = moment.cycle_rate * march.control.step
    advance += cycle_shift(train, end.x) - cycle_shift(train, begin.x)
    rate = begin.side[i] * (moment.cycle_rate + cycle_shift(train, end.v))
    edge = begin.segment[i] + (1 if rate > 0.0 else 0)
    left = train.edge[train.kind[i], edge] - moment.start[i] - begin.side[i] * advance
    return left / rate


@kernel
def pass_edges(model: Record, march: Record) -> None:
    """Change the segment of every mesh that has come to the edge of its own."""
    train, end, moment = model.train, march.end, march.moment
    advance = moment.cycle_rate * march.control.step
    advance += cycle_shift(train, end.x) - cycle_shift(train, march.begin.x)
    pace = moment.cycle_rate + cycle_shift(train, end.v)
    for i in range(train.meshes):
        cycle, ahead = moment.start[i] + moment.side[i] * advance, moment.side[i] * pace
        if ahead > 0.0 and cycle >= moment.high[i] - EDGE:
            _pass_edge(model, march, i, 1)
        elif ahead < 0.0 and cycle <= moment.low[i] + EDGE:
            _pass_edge(model, march, i, -1)


@kernel
def _pass_edge(model: Record, march: Record, i: int, direction: int) -> None:
    """Change the segment of mesh i until it has come to the edge of its own no more."""
    train, end, side = model.train, march.end, march.end.side[i]
    for _ in range(train.segments[train.kind[i]]):
        if side == OPEN or not _at_edge(train, end, i, direction):
            return
        change_segment(model, end, march.aside, i, direction)
        march.control.pair_events += int(model.train.copies[i])
        march.control.changed = True


@kernel
def _at_edge(train: Record, end: Record, i: int, direction: int) -> bool:
    """Whether mesh i has come to the edge of its segment that lies in a direction."""
    kind, segment = train.kind[i], end.segment[i]
    cycle = nearest_to_segment(train, kind, segment, mesh_cycle(train, end, i, end.side[i]))
    if direction > 0:
        return cycle >= train.edge[kind, segment + 1] - EDGE
    return cycle <= train.edge[kind, segment] + EDGE
