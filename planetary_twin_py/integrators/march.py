"""Drive the one-step methods from event to event and sample what lies between.

Events are tooth pairs entering or leaving, flanks meeting or parting, and the speed set-point
reaching its target. Steps end on them, so the equations are smooth within every step. The window
a caller asks for never clips a step: samples come from the step's interpolant, and the state at
the end of the window is that of the last step begun. So the path does not depend on the windows.

Steps are made by collocation; where that is unfit, Rosenbrock's method takes over for a while.
Where nothing changes any more from one mesh cycle to the next, none are made.
"""

from __future__ import annotations

from .._compile import kernel
from .._overwrite import overwrite
from .._records import Record
from ..dynamics.contact_events import change_contact
from ..dynamics.moment import set_moment
from ..dynamics.tooth_friction import friction_layer
from .both_flanks import note_both_flanks
from .clock import Instant, Sampling, after, delay, due, sampling
from .collocated_step import FAILED, collocated_step
from .creep import avoid_reversals, hold_or_slide
from .edges import next_event, pass_edges
from .frame import rebase
from .interpolant import Samples, new_samples, sample
from .progress import COLLOCATION, DETOUR, NO_MESH, ROSENBROCK, SHORTEST_STEP
from .repetition import forget, play, watch
from .step_sums import sum_step
from .stiff_step import stiff_step
from .window_sums import count_step

# Errors of speeds, over the layer in which friction reverses, in tolerances: where pairs slide, and
# where they hold and the gears may stick and slip.
SLIDING_SHARE, CREEPING_SHARE = 60.0, 1.0


@kernel
def begin_step(model: Record, march: Record) -> None:
    """Start a new step where the last one ended."""
    overwrite(march.begin, march.end)
    rebase(model.train, march.begin)
    set_moment(model, march.begin, march.moment)
    hold_or_slide(model, march)
    _set_tolerances(model, march)
    avoid_reversals(model, march)
    note_both_flanks(model, march)


@kernel
def _set_tolerances(model: Record, march: Record) -> None:
    """Allow errors in proportion to what the meshes yield, be it to torques or to inertia.

    Friction turns round within a narrow layer of sliding speeds: where the gears turn slowly, this
    is what an error of a speed is measured by.
    """
    train, control = model.train, march.control
    deflection = control.deflection
    for a in range(train.axes):
        deflection += control.yielding[a] * abs(march.moment.slew[a])
    control.tolerance_x = control.tolerance * deflection
    control.tolerance_v = control.tolerance_x * control.quickness
    if train.friction:
        share = CREEPING_SHARE if control.creeping else SLIDING_SHARE
        layer = friction_layer(train, model.oil, march.moment.cycle_rate)
        allowed = share * control.tolerance * layer
        control.slow = allowed < control.tolerance_v
        control.tolerance_v = min(control.tolerance_v, allowed)


@kernel
def one_step(model: Record, march: Record, longest: float) -> None:
    """One accepted step of at most `longest` seconds from `begin`, ending on the first event."""
    control = march.control
    march.sums.stale = control.changed or control.collocated
    event, mesh = next_event(model, march)
    longest, changing = min(longest, control.longest), FAILED
    collocates = control.method != ROSENBROCK and not control.creeping
    if collocates and (control.detour == 0 or control.method == COLLOCATION):
        changing = collocated_step(model, march, longest, event, mesh)
        if changing == FAILED:
            control.detour = DETOUR
            control.changed = True
    if changing == FAILED:
        changing = stiff_step(model, march, longest, event)
    accept(model, march, changing)


@kernel
def accept(model: Record, march: Record, mesh: int) -> None:
    """Let the step stand; `mesh` changes its contact at its end (NO_MESH: none)."""
    sum_step(model, march)
    if mesh != NO_MESH:
        change_contact(model, march.end, march.aside, mesh)
        march.control.flank_events += int(model.train.copies[mesh])
        march.control.changed = True
    pass_edges(model, march)
    for a in range(model.train.axes):
        gap = model.load.target_speed[a] - march.end.set_speed[a]
        if gap * march.moment.slew[a] <= 0.0 or abs(gap) < 1e-12 * model.load.slew_rate:
            march.end.set_speed[a] = model.load.target_speed[a]
            march.control.changed |= march.moment.slew[a] != 0.0
    march.control.steps += 1


@kernel
def advance(
    model: Record, march: Record, until: Instant, bound: Instant, samples: Sampling, out: Samples
) -> None:
    """Integrate to `until`, and fill `out` with `samples`, none of them later, and one at `until`.

    No step that is made passes `bound`.
    """
    taken, room = 0, len(out.turns) - 1
    while True:
        while taken < room and delay(march.end, due(samples)) <= 0.0:
            sample(model, march, delay(march.begin, due(samples)), out, taken)
            samples = after(samples)
            taken += 1
        if taken == room and delay(march.end, until) <= 0.0:
            sample(model, march, delay(march.begin, until), out, room)
            return
        count_step(model, march)
        if march.repetition.playing:
            play(model, march, due(samples) if taken < room else until)
        else:
            begin_step(model, march)
            one_step(model, march, delay(march.begin, bound))
            watch(model, march)


def cut(model: Record, march: Record, until: Instant) -> None:
    """Take back what lies beyond `until`, which is within the last step.

    What changes from outside, changes there: the next step begins at it.
    """
    forget(march)
    if delay(march.end, until) < 0.0:
        march.end = march.begin
        march.control.changed = True
        close = Instant(until.seconds, until.time - SHORTEST_STEP)
        advance(model, march, close, until, sampling(0, 1.0), new_samples(model.train, 1))
        forget(march)
    march.end.seconds, march.end.time = until.seconds, until.time
    march.control.changed = True
