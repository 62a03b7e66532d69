"""A step by Rosenbrock's method: how long it is, and where it ends.

Near standstill friction is too stiff for the sweeps of collocation to come to rest, and damping
too strong for its digits.
"""

from __future__ import annotations

import math

from .._compile import kernel
from .._overwrite import copy_array, overwrite
from .._records import Record
from ..dynamics.bristles import place_bristles
from ..dynamics.equations import forces
from ..dynamics.mesh_force import mesh_motion
from ..dynamics.state import LEDGER
from ..dynamics.tooth_friction import copy_friction
from .edges import planned
from .flanks import at_event, first_flank_event
from .frame import pass_time
from .progress import GROW, NO_MESH, SAFETY, SHORTEST_STEP, SHRINK
from .rosenbrock import ORDER, step

STIFF = 3.0  # by which errors count more
BRISTLE_SHARE = 1.0  # of the tolerance: error of the share of friction of a pair that holds
ROUNDING = 1e-15  # [m/s] errors of a speed below it are none


@kernel
def stiff_step(model: Record, march: Record, longest: float, event: float) -> int:
    """A step by Rosenbrock's method; the mesh whose flanks meet or part at its end, or NO_MESH."""
    control, begin = march.control, march.begin
    if control.changed or control.collocated:
        place_bristles(march.first.pairs, begin.bristle)
        forces(model, begin, march.moment, begin.x, begin.v, 0.0, begin.trim, march.first)
        control.evaluations += 1
        control.changed = False
    else:  # forces do not depend on the frame in which x is measured
        copy_array(march.first.force, march.last.force)
        copy_array(march.first.power, march.last.power)
        copy_friction(march.last.pairs, march.first.pairs)
    control.collocated = False
    h = min(planned(event, min(control.next_stiff, longest), 1.0), longest)
    h, factor = _controlled(model, march, h)
    candidate = h * min(GROW, max(SHRINK, factor))
    # A step cut short by an event says little about the steps to come.
    control.next_stiff = max(candidate, control.next_stiff) if factor >= 1.0 else candidate
    control.detour = max(control.detour - 1, 0)
    control.stiff_steps += 1
    return _end_on_flank_event(model, march, h)


@kernel
def _controlled(model: Record, march: Record, h: float) -> tuple[float, float]:
    """Try steps from h downwards until the error is allowed; the step, and how it may change."""
    while True:
        _try(model, march, h)
        error = STIFF * _error_norm(model, march)
        factor = SAFETY * error ** (-1.0 / ORDER) if error > 0.0 else GROW
        if error <= 1.0 or (h <= SHORTEST_STEP and error < math.inf):
            return h, factor
        if h <= SHORTEST_STEP:
            raise ArithmeticError("no finite state can be reached, however short the step")
        march.control.rejected += 1
        h = max(h * max(SHRINK, factor), SHORTEST_STEP)


@kernel
def _try(model: Record, march: Record, h: float) -> None:
    """One step of h from `begin` into `end`, without regard to events."""
    begin, end = march.begin, march.end
    overwrite(end, begin)
    step(model, begin, march.moment, h, march.first, end, march.work)
    pass_time(model, march, h)
    for e in range(LEDGER):
        end.energy[e] = begin.energy[e] + march.work.energy[e]
    place_bristles(march.last.pairs, end.bristle)
    forces(model, begin, march.moment, end.x, end.v, h, end.trim, march.last)
    march.control.evaluations += 4


@kernel
def _error_norm(model: Record, march: Record) -> float:
    """Largest local error of a mesh or of the speed of a body, relative to its tolerance.

    Infinite where the step went astray: a comparison with NaN would let it pass.
    """
    work, control = march.work, march.control
    largest = total = 0.0
    for i in range(model.train.meshes):
        tau = march.moment.tau[model.train.kind[i]]
        error = abs(mesh_motion(model.train, i, work.error_x))
        # Damping turns an error of the rate into one of the force, k tau times as large.
        slip = max(abs(mesh_motion(model.train, i, work.error_v)) - ROUNDING, 0.0)
        error = max(error, tau * slip)
        largest = max(largest, error / control.tolerance_x)
    for j in range(model.train.bodies):
        largest = max(largest, abs(work.error_v[j]) / control.tolerance_v)
        total += work.error_v[j]
    if control.creeping:
        for k in range(model.train.slots * model.train.meshes):
            error = abs(work.error_bristle[k])
            largest = max(largest, error / (BRISTLE_SHARE * control.tolerance))
            total += error
    return largest if math.isfinite(total) else math.inf


@kernel
def _end_on_flank_event(model: Record, march: Record, h: float) -> int:
    """Let the step end where a mesh changes its contact first; that mesh, or NO_MESH."""
    mesh, when = first_flank_event(model, march)
    if mesh != NO_MESH and h > SHORTEST_STEP and not at_event(model, march, mesh):
        _try(model, march, max(when, SHORTEST_STEP))
    return mesh
