"""Drive the one-step methods from event to event and sample what lies between.

Events are tooth pairs entering or leaving, flanks meeting or parting, and the speed set-point
reaching its target. Steps end on them, so the equations are smooth within every step. The window
a caller asks for never clips a step: samples come from the step's interpolant, and the state at
the end of the window is that of the last step begun. So the path does not depend on the windows.

Steps are made by collocation. Near standstill friction is too stiff for its sweeps to come to
rest, and damping too strong for its digits; Rosenbrock's method then takes over for a while.
"""

from __future__ import annotations

import math

from .._compile import kernel
from .._records import Record
from ..dynamics.contact_events import change_contact, change_segment
from ..dynamics.cycle import cycle_shift, mesh_cycle, nearest_to_segment
from ..dynamics.equations import drive, forces, squeeze
from ..dynamics.mesh_force import mesh_motion, move_meshes
from ..dynamics.moment import set_moment
from ..dynamics.state import OPEN
from ..dynamics.tooth_friction import copy_friction
from .clock import Instant, Sampling, after, delay, due, run_on
from .collocation import collocate
from .flanks import at_event, first_flank_event
from .interpolant import Samples, sample
from .memory import remember
from .progress import COLLOCATION, ROSENBROCK, copy_state
from .propagation import enter, integrate_powers, propagate, resolves, trim_at
from .rosenbrock import ORDER, step

SHORTEST_STEP = 1e-13  # [s] below it two events count as one
EDGE = 1e-9  # [-] mesh cycles within which a tooth pair counts as having entered or left
ON_EDGE = 1e-13  # [s] to which a step of collocation ends on the edge of a tooth pair
WITHIN = 0.1  # of the step, by which its end is moved for that at most
NEAREST, FARTHEST = 0.1, 0.9  # by which a step is shortened at a time to meet a flank event
SAFETY, SHRINK, GROW = 0.8, 0.25, 2.0
STRETCH = 1.2  # by which a planned step is stretched to end on an event
DETOUR = 20  # steps of Rosenbrock's method before collocation is tried again
OUTDONE = 0.2  # of the other method's step, below which it is taken
STIFF = 3.0  # by which errors of Rosenbrock's method count more
ROUNDING = 1e-15  # [m/s] errors of a speed below it are none


@kernel
def _rebase(train: Record, state: Record) -> None:
    """Let the frame catch up with the motors: their x and v become zero."""
    for a in range(train.axes):
        motor = train.coupling[2 * a, 0]
        angle, rate = state.x[motor] / train.radius[motor], state.v[motor] / train.radius[motor]
        for j in range(train.bodies):
            state.x[j] -= train.ratio[j, a] * train.radius[j] * angle
            state.v[j] -= train.ratio[j, a] * train.radius[j] * rate
        state.x[motor] = 0.0
        state.v[motor] = 0.0
        state.speed[a] += rate
        _turn(state, a, angle / (2.0 * math.pi))


@kernel
def _turn(state: Record, a: int, turns: float) -> None:
    """Turn the frame with motor a; whole turns are counted apart."""
    fraction = state.fraction[a] + turns
    state.turns[a] += math.floor(fraction)
    state.fraction[a] = fraction - math.floor(fraction)


@kernel
def _next_event(model: Record, march: Record) -> tuple[float, int]:
    """Time [s] to the next tooth pair event or change of the set-point's slope, and the mesh."""
    train, state, moment = model.train, march.begin, march.moment
    pace = moment.cycle_rate + cycle_shift(train, state.v)
    nearest, mesh = math.inf, -1
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
                nearest, mesh = gap / moment.slew[a], -1
    return max(nearest, SHORTEST_STEP), mesh


@kernel
def begin_step(model: Record, march: Record) -> None:
    """Start a new step where the last one ended."""
    copy_state(march.end, march.begin)
    _rebase(model.train, march.begin)
    set_moment(model, march.begin, march.moment)
    _set_tolerances(model.train, march)


@kernel
def _set_tolerances(train: Record, march: Record) -> None:
    """Allow errors in proportion to what the meshes yield, be it to torques or to inertia."""
    control = march.control
    deflection = control.deflection
    for a in range(train.axes):
        deflection += control.yielding[a] * abs(march.moment.slew[a])
    control.tolerance_x = control.tolerance * deflection
    control.tolerance_v = control.tolerance_x * control.quickness


@kernel
def one_step(model: Record, march: Record, longest: float) -> None:
    """One accepted step of at most `longest` seconds from `begin`, ending on the first event."""
    control = march.control
    event, mesh = _next_event(model, march)
    if control.method != ROSENBROCK and (control.detour == 0 or control.method == COLLOCATION):
        if _collocated_step(model, march, min(longest, control.longest), event, mesh):
            return
        control.detour = DETOUR
        control.changed = True
    _stiff_step(model, march, min(longest, control.longest), event)


@kernel
def _planned(event: float, h: float, stretch: float) -> float:
    """A step of about h that does not leave a tiny one before the event."""
    if event <= stretch * h:
        return event
    return 0.5 * event if event < 2.0 * h else h


@kernel
def _collocated_step(model: Record, march: Record, longest: float, event: float, mesh: int) -> bool:
    """A step by collocation, at whose end `mesh` may come to an edge; False where it fails."""
    control, run, order = march.control, march.run, march.run.nodes.count
    _hold_friction(model, march)
    enter(model, march)
    # Meshing returns to the same contacts: the step that did then, will do.
    known, modes, fresh = run.known, run.modes, control.changed
    h = known.step[modes] if fresh and known.step[modes] > 0.0 else control.next_step
    h = min(_planned(event, min(h, longest), STRETCH), longest)
    restless = 0
    while True:
        if control.method != COLLOCATION and not resolves(run, model.train.bodies, h):
            return False
        error, settled = collocate(model, march, h, fresh)
        if error <= 1.0 or (h <= SHORTEST_STEP and error < math.inf):
            break
        restless += 0 if settled else 1
        shorter = h * max(SHRINK, SAFETY * error ** (-1.0 / order))
        if h <= SHORTEST_STEP or _outdone(control, shorter, settled, restless):
            return False
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
    if mesh >= 0 and h == event:
        _meet_edge(model, march, mesh, h)
    march.last.power[:] = run.evaluation[order - 1].power
    march.last.rubbing[:] = run.evaluation[order - 1].rubbing
    accept(model, march, _end_on_flank_event(model, march, h))
    return True


@kernel
def _outdone(control: Record, h: float, settled: bool, restless: int) -> bool:
    """Whether Rosenbrock's method is to be taken rather than collocation over h seconds."""
    if control.method == COLLOCATION:
        return False
    if not settled and (restless > 1 or h < control.next_stiff):
        return True
    return h < OUTDONE * control.next_stiff


@kernel
def _hold_friction(model: Record, march: Record) -> None:
    """Forces at the start of a step, but with the friction of the end of the last."""
    begin, moment, first = march.begin, march.moment, march.first
    move_meshes(model.train, begin.x, begin.v, first.now)
    squeeze(model, begin, moment, begin.x, begin.v, 0.0, first)
    first.rubbing[:] = march.last.rubbing
    drive(model, begin, moment, begin.x, begin.v, 0.0, begin.trim, first)


@kernel
def end_within(model: Record, march: Record, h: float) -> None:
    """Let the step of collocation end after h seconds, on its own motion."""
    begin, end = march.begin, march.end
    copy_state(begin, end)
    if h == march.run.step:
        last = march.run.nodes.count - 1
        end.x[:], end.v[:] = march.run.node_x[last], march.run.node_v[last]
        end.trim[:] = march.run.node_trim[last]
    else:
        propagate(model, march, h, end.x, end.v)
        trim_at(model, march, h, end.x, end.trim)
    integrate_powers(march, model.train.lanes, h)
    _pass_time(model, march, h)


@kernel
def _pass_time(model: Record, march: Record, h: float) -> None:
    """Let clock, set-points and frame of `end` run on for h seconds."""
    begin, end = march.begin, march.end
    run_on(begin, end, h)
    for a in range(model.train.axes):
        end.set_speed[a] = begin.set_speed[a] + march.moment.slew[a] * h
        _turn(end, a, begin.speed[a] * h / (2.0 * math.pi))
    march.control.step = h


@kernel
def _meet_edge(model: Record, march: Record, mesh: int, h: float) -> None:
    """Move the end of the step to where `mesh` comes to the edge of its segment (Newton).

    Where the pace has changed too much for that, the next steps come to the edge.
    """
    for _ in range(3):
        gap = _time_to_edge(model, march, mesh)
        if abs(gap) < ON_EDGE or not abs(gap) < WITHIN * h:
            return
        h += gap
        end_within(model, march, h)


@kernel
def _time_to_edge(model: Record, march: Record, i: int) -> float:
    """Time [s] by which mesh i is short of the edge of its segment at the end of the step."""
    train, begin, end, moment = model.train, march.begin, march.end, march.moment
    advance = moment.cycle_rate * march.control.step
    advance += cycle_shift(train, end.x) - cycle_shift(train, begin.x)
    rate = begin.side[i] * (moment.cycle_rate + cycle_shift(train, end.v))
    edge = begin.segment[i] + (1 if rate > 0.0 else 0)
    left = train.edge[train.kind[i], edge] - moment.start[i] - begin.side[i] * advance
    return left / rate


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
    return largest if math.isfinite(total) else math.inf


@kernel
def _try(model: Record, march: Record, h: float) -> None:
    """One step of h from `begin` into `end`, without regard to events."""
    begin, end = march.begin, march.end
    copy_state(begin, end)
    step(model, begin, march.moment, h, march.first, end, march.work)
    _pass_time(model, march, h)
    end.energy[:] = begin.energy + march.work.energy
    forces(model, begin, march.moment, end.x, end.v, h, end.trim, march.last)
    march.control.evaluations += 4


@kernel
def _stiff_step(model: Record, march: Record, longest: float, event: float) -> None:
    """A step by Rosenbrock's method."""
    control, begin = march.control, march.begin
    if control.changed or control.collocated:
        forces(model, begin, march.moment, begin.x, begin.v, 0.0, begin.trim, march.first)
        control.evaluations += 1
        control.changed = False
    else:  # forces do not depend on the frame in which x is measured
        march.first.force[:] = march.last.force
        march.first.power[:] = march.last.power
        copy_friction(march.last.pairs, march.first.pairs)
    control.collocated = False
    h = min(_planned(event, min(control.next_stiff, longest), 1.0), longest)
    h, factor = _controlled(model, march, h)
    candidate = h * min(GROW, max(SHRINK, factor))
    # A step cut short by an event says little about the steps to come.
    control.next_stiff = max(candidate, control.next_stiff) if factor >= 1.0 else candidate
    control.detour = max(control.detour - 1, 0)
    control.stiff_steps += 1
    accept(model, march, _end_on_flank_event(model, march, h))


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
def _end_on_flank_event(model: Record, march: Record, h: float) -> int:
    """Shorten the step until it ends where a mesh changes its contact; that mesh, or -1.

    The interpolant of a long stiff step may put the event anywhere, so each shorter step is
    looked at afresh; one that turns out to end before the event is as good as any. The motion of
    a step of collocation stays what it is.
    """
    target = -1
    while True:
        mesh, when = first_flank_event(model, march)
        if mesh < 0 and target >= 0 and at_event(model, march, target):
            return target
        if mesh < 0 or h <= SHORTEST_STEP or at_event(model, march, mesh):
            return mesh
        target = mesh
        if march.control.collocated:
            end_within(model, march, when)
            return mesh
        h = max(min(max(when, NEAREST * h), FARTHEST * h), SHORTEST_STEP)
        _try(model, march, h)


@kernel
def _pass_edges(model: Record, march: Record) -> None:
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
        march.control.pair_events += 1
        march.control.changed = True


@kernel
def _at_edge(train: Record, end: Record, i: int, direction: int) -> bool:
    """Whether mesh i has come to the edge of its segment that lies in a direction."""
    kind, segment = train.kind[i], end.segment[i]
    cycle = nearest_to_segment(train, kind, segment, mesh_cycle(train, end, i, end.side[i]))
    if direction > 0:
        return cycle >= train.edge[kind, segment + 1] - EDGE
    return cycle <= train.edge[kind, segment] + EDGE


@kernel
def accept(model: Record, march: Record, mesh: int) -> None:
    """Let the step stand; `mesh` changes its contact at its end (-1: none)."""
    if mesh >= 0:
        change_contact(model, march.end, march.aside, mesh)
        march.control.flank_events += 1
        march.control.changed = True
    _pass_edges(model, march)
    for a in range(model.train.axes):
        gap = model.load.target_speed[a] - march.end.set_speed[a]
        if gap * march.moment.slew[a] <= 0.0 or abs(gap) < 1e-12 * model.load.slew_rate:
            march.end.set_speed[a] = model.load.target_speed[a]
            march.control.changed |= march.moment.slew[a] != 0.0
    march.control.steps += 1


@kernel
def advance(model: Record, march: Record, until: Instant, samples: Sampling, out: Samples) -> None:
    """Integrate to `until`, and fill `out` with `samples`, none of them later."""
    taken, room = 0, len(out.turns)
    while True:
        while taken < room and delay(march.end, due(samples)) <= 0.0:
            sample(model, march, delay(march.begin, due(samples)), out, taken)
            samples = after(samples)
            taken += 1
        if taken == room and delay(march.end, until) <= 0.0:
            return
        begin_step(model, march)
        one_step(model, march, math.inf)


@kernel
def cut(model: Record, march: Record, until: Instant) -> None:
    """Take back what lies beyond `until`, which is within the last step.

    What changes from outside, changes there: the next step begins at it.
    """
    if delay(march.end, until) < 0.0:
        length = delay(march.begin, until)
        march.control.changed = True
        if length > SHORTEST_STEP:
            one_step(model, march, length)
        else:
            copy_state(march.begin, march.end)
        while delay(march.end, until) > SHORTEST_STEP:  # an event came before
            begin_step(model, march)
            one_step(model, march, delay(march.end, until))
    march.end.seconds, march.end.time = until.seconds, until.time
    march.control.changed = True
