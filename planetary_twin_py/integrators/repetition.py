"""Steady running: mesh cycles that come back to where they began are not computed again.

Once all that the train depends on has come round, so that it stands where it stood to a small
share of the tolerance, and has done so for longer than anything in it takes to settle, its last
cycle is kept and repeats until something acts on the train from outside. Dense output reads a
repeated step as it reads a computed one.

The cycle lasts as long as the speed set-point takes for it: the speed loop would not let it drift.
"""

from __future__ import annotations

import math

from .._compile import kernel
from .._overwrite import copy_array, overwrite
from .._records import BODIES, FLAG, REAL, WHOLE, Record, layout
from ..dynamics.body_speed import body_speed
from ..dynamics.bristles import place_bristles
from ..dynamics.equations import forces
from ..dynamics.mesh_force import mesh_motion
from ..dynamics.mesh_sums import MESH_SUMS, add_sums
from ..dynamics.moment import set_moment
from ..dynamics.state import LEDGER, OPEN, STATE
from .clock import Instant, delay, run_on
from .propagation import MOTION

TAPE = 4096  # steps of the longest cycle that is kept
SHARE = 0.3  # of the tolerance, by which a train that repeats may miss where it was
SETTLED = 0.25  # of all cycles so far, for which the train must not stray
PHASE = 20.0  # static deflections by which the teeth yield otherwise, a mesh cycle late

# A state within the cycle that repeats.
PLACE = layout(
    state=STATE,
    after=REAL,  # start of the cycle [s]
    turned=REAL,  # by the motor since then [turns]
    energy=(REAL, (LEDGER,)),  # growth of the ledger since then [J], [N m s]
)

# A step of it.
STEP = layout(
    begin=PLACE,
    end=PLACE,
    collocated=FLAG,
    power=(REAL, (LEDGER,)),  # at its end, see EVALUATION
    rubbing=(REAL, (BODIES,)),
    motion=MOTION,
    sums=MESH_SUMS,
)

# What is known of repetition.
REPETITION = layout(
    cycles=WHOLE,  # mesh cycles until all is as before, 0: never
    numerator=WHOLE,  # turns of the motor meanwhile, as a fraction
    denominator=WHOLE,
    pause=REAL,  # [s] for which the train must not stray at least
    passed=WHOLE,  # mesh cycles since it was last looked whether the train repeats
    age=WHOLE,  # times that it was since something acted from outside
    anchor_age=WHOLE,
    anchor=STATE,  # from which the train has not strayed since
    recording=FLAG,
    playing=FLAG,
    steps=WHOLE,  # on the tape
    place=WHOLE,  # of the step on the tape that comes next
    known=WHOLE,  # contact states known when the last step was put on the tape
    start=STATE,  # clock, turns and ledger where the present cycle starts; the fraction of the ...
    part=WHOLE,  # ... turn is that of the first cycle, and this many denominators
    whole=PLACE,  # end of the cycle
    tape=(STEP, (TAPE,)),
)


@kernel
def watch(model: Record, march: Record) -> None:
    """Look whether the step just made ends where the train has been before."""
    repetition = march.repetition
    if repetition.cycles == 0:
        return
    if repetition.recording:
        _record(march)
    if not _comes_round(march):
        return
    repetition.passed += 1
    if repetition.passed < repetition.cycles:
        return
    repetition.passed = 0
    _look(model, march)


def forget(march: Record) -> None:
    """Something acts on the train from outside: it must settle anew."""
    repetition = march.repetition
    repetition.age = repetition.anchor_age = repetition.passed = 0
    repetition.recording = repetition.playing = False


@kernel
def _comes_round(march: Record) -> bool:
    """Whether a mesh cycle begins at the end of the step."""
    begin, end = march.begin, march.end
    return begin.segment[0] != 0 and end.segment[0] == 0 and end.side[0] != OPEN


@kernel
def _look(model: Record, march: Record) -> None:
    repetition, end = march.repetition, march.end
    repetition.age += 1
    near = _distance(model, march, end, repetition.anchor) <= SHARE * march.control.tolerance
    if repetition.recording:
        repetition.recording = False
        repetition.playing = near and _close(model, march)
    elif near:
        since = repetition.age - repetition.anchor_age
        stayed = delay(repetition.anchor, _now(end))
        if since < SETTLED * repetition.age or stayed < repetition.pause:
            return
        repetition.recording = True
        repetition.steps = repetition.known = 0
    repetition.anchor_age = repetition.age
    overwrite(repetition.anchor, end)


@kernel
def _now(state: Record) -> Instant:
    return Instant(state.seconds, state.time)


@kernel
def _distance(model: Record, march: Record, a: Record, b: Record) -> float:
    """How far two states are apart in what the meshes yield, relative to the static deflection."""
    train, control, load = model.train, march.control, model.load
    largest = 0.0
    for i in range(train.meshes):
        if a.side[i] != b.side[i] or a.segment[i] != b.segment[i]:
            return math.inf
        largest = max(largest, abs(mesh_motion(train, i, a.x) - mesh_motion(train, i, b.x)))
    stiffness = min(train.stiffness[0], train.stiffness[1])
    for c in range(train.machines):
        p, q = train.coupling[c, 0], train.coupling[c, 1]
        twist = a.x[p] - a.x[q] - b.x[p] + b.x[q]
        largest = max(largest, abs(twist) * train.coupling_stiffness[c] / stiffness)
    for j in range(train.bodies):
        speed = body_speed(train, a, a.v, j) - body_speed(train, b, b.v, j)
        largest = max(largest, abs(speed) * train.radius[j] / control.quickness)
    for k in range(train.axes):
        if a.set_speed[k] != load.target_speed[k] or b.set_speed[k] != load.target_speed[k]:
            return math.inf
        late = (a.trim[k] - b.trim[k]) * train.cycles[k] / (2.0 * math.pi)
        largest = max(largest, abs(late) * PHASE * control.deflection)
    for k in range(train.slots * train.meshes if control.creeping else 0):
        largest = max(largest, abs(a.bristle[k] - b.bristle[k]) * control.deflection)
    return largest / control.deflection


@kernel
def _record(march: Record) -> None:
    """Put the step just made on the tape, unless there is no room or its modes were lost."""
    repetition, known = march.repetition, march.run.known
    place = repetition.steps
    if place == TAPE:
        repetition.cycles = 0
    if place == TAPE or known.count < repetition.known:
        repetition.recording = False
        return
    if place == 0:
        overwrite(repetition.start, march.begin)
    step = repetition.tape[place]
    _keep(repetition.start, march.begin, step.begin)
    _keep(repetition.start, march.end, step.end)
    step.collocated = march.control.collocated
    copy_array(step.power, march.last.power)
    copy_array(step.rubbing, march.last.rubbing)
    overwrite(step.motion, march.run.motion)
    overwrite(step.sums, march.sums.step)
    repetition.steps = place + 1
    repetition.known = known.count


@kernel
def _keep(start: Record, state: Record, place: Record) -> None:
    """Fill `place` with a state, as it lies after the start of the cycle."""
    overwrite(place.state, state)
    place.after = delay(start, _now(state))
    place.turned = state.turns[0] - start.turns[0] + (state.fraction[0] - start.fraction[0])
    for e in range(LEDGER):
        place.energy[e] = state.energy[e] - start.energy[e]


@kernel
def _close(model: Record, march: Record) -> bool:
    """Let the cycle end as exactly as set-point and teeth say; whether it does."""
    repetition, end, train = march.repetition, march.end, model.train
    whole, motor = repetition.whole, train.coupling[0, 0]
    _keep(repetition.start, end, whole)
    took = whole.after
    turned = whole.turned + end.x[motor] / train.radius[motor] / (2.0 * math.pi)
    whole.turned = math.copysign(repetition.numerator / repetition.denominator, turned)
    whole.after = whole.turned * 2.0 * math.pi / model.load.target_speed[0]
    repetition.place, repetition.part = repetition.steps, 0
    late = max(abs(took / whole.after - 1.0), abs(turned / whole.turned - 1.0))
    return late * repetition.cycles * PHASE <= SHARE * march.control.tolerance


@kernel
def play(model: Record, march: Record, until: Instant) -> None:
    """Go on to the step of the cycle that ends at or after `until`."""
    repetition = march.repetition
    while True:
        if repetition.place == repetition.steps:
            _begin_cycle(repetition)
        step = repetition.tape[repetition.place]
        repetition.place += 1
        march.control.repeated += 1
        if delay(repetition.start, until) <= step.end.after:
            break
        add_sums(step.sums, march.sums.total, model.train.lanes)
    _stand(repetition, step.begin, march.begin)
    _stand(repetition, step.end, march.end)
    march.control.collocated, march.control.step = (
        step.collocated,
        step.end.after - step.begin.after,
    )
    copy_array(march.last.power, step.power)
    copy_array(march.last.rubbing, step.rubbing)
    overwrite(march.run.motion, step.motion)
    overwrite(march.sums.step, step.sums)
    begin, moment = march.begin, march.moment
    set_moment(model, begin, moment)
    if not step.collocated:  # dense output makes the step anew
        place_bristles(march.first.pairs, begin.bristle)
        forces(model, begin, moment, begin.x, begin.v, 0.0, begin.trim, march.first)


@kernel
def _begin_cycle(repetition: Record) -> None:
    """Move the start on by a cycle; the motor's turns are counted in whole parts."""
    start, whole = repetition.start, repetition.whole
    run_on(start, start, whole.after)
    for e in range(LEDGER):
        start.energy[e] += whole.energy[e]
    repetition.part += repetition.numerator if whole.turned > 0.0 else -repetition.numerator
    turns = repetition.part // repetition.denominator
    repetition.part -= turns * repetition.denominator
    start.turns[0] += turns
    repetition.place = 0


@kernel
def _stand(repetition: Record, place: Record, state: Record) -> None:
    """Let `state` be at a place in the present cycle."""
    start = repetition.start
    overwrite(state, place.state)
    run_on(start, state, place.after)
    turns = start.fraction[0] + place.turned + repetition.part / repetition.denominator
    state.turns[0] = start.turns[0] + math.floor(turns)
    state.fraction[0] = turns - math.floor(turns)
    for e in range(LEDGER):
        state.energy[e] = start.energy[e] + place.energy[e]
