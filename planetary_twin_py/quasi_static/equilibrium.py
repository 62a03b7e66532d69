"""Static equilibrium of the train at one instant: torques, tooth forces, friction and drag.

The motors keep their speeds, so along each rigid motion the load (and the second motor of a
differential) gives what friction, drag and the inertia of a changing speed leave to be given.
Tooth forces are those of bodies at rest in the frame that turns with the motors. Friction depends
on them and they on friction, by some hundredths: a few passes bring both together. All laws are
those of the dynamic model, applied to a state whose x squeezes every mesh by its static force.
"""

from __future__ import annotations

import math

import numpy as np

from .._compile import kernel, law
from .._overwrite import copy_array
from .._records import AXES, BODIES, MACHINES, MESHES, REAL, WHOLE, Record, layout, new_record
from ..dynamics.bodies import LOAD_MACHINE, MOTOR, SECOND_MOTOR
from ..dynamics.body_speed import body_speed
from ..dynamics.cycle import cycle_shift, find_segment, mesh_cycle
from ..dynamics.equations import EVALUATION, rub
from ..dynamics.form_errors import form_error, radial_error
from ..dynamics.mesh_force import (
    fault_effect,
    mesh_motion,
    mesh_stiffness,
    polynomial,
    total_weight,
)
from ..dynamics.moment import MOMENT, frame_cycle_rate, set_moment, take_segment
from ..dynamics.observe import MESH_FORCE, observe
from ..dynamics.state import COAST_SIDE, DRIVE_SIDE, IMPULSE, OPEN, STATE, WORK
from .planet_load import SPRINGS, planet_force, share

MOST_PASSES = 60
BRISK_PASSES = 5  # then what is thrown to and fro is brought to rest
FREE_PASSES = 20  # then tooth pairs stay: at a jump of the stiffness they may not come to rest
DITHER = 0.05  # [N] below which, then, the friction of a mesh that hardly touches counts as settled
PLACE = 0.01  # mesh cycles over which stiffness changes by as much as counts for the tolerance
LIGHTEST_FORCE = 1.0  # [N] smaller mesh forces do not tighten the tolerance further
LEAST_STIFFNESS = 1e-9  # of a healthy mesh: one whose only pair is just entering
DRIVE_PLAY, COAST_PLAY = 0, 1

# The train in equilibrium; from one instant to the next, a first guess.
EQUILIBRIUM = layout(
    state=STATE,
    moment=MOMENT,
    evaluation=EVALUATION,
    before=(REAL, (BODIES,)),  # what rubbed in the pass before [N]
    lean=(WHOLE, (MESHES,)),  # side to which an open mesh would close
    error=(REAL, (MESHES,)),  # of form, its tangential part [m]
    stiffness=(REAL, (MESHES,)),  # [N/m]
    play=(REAL, (MESHES, 2)),  # from the middle to the flank that carries, on both sides [m]
    force=(REAL, (MESHES,)),  # signed [N]
    torque=(REAL, (MACHINES,)),  # [N m]
    balance=(REAL, (AXES,)),  # torques to be balanced along each rigid motion [N m]
    external=(REAL, (BODIES,)),  # all forces but those of the meshes [N]
    springs=SPRINGS,
)


def first_guess(lean: int) -> Record:
    """An equilibrium still to be found, the teeth on the side `lean`."""
    run = new_record(EQUILIBRIUM)
    run.lean[:] = lean
    return run


@kernel
def settle(model: Record, tolerance: float, run: Record, shown: np.ndarray) -> None:
    """Bring `run`, whose frame stands where it is to be, into equilibrium; fill `shown`.

    Args:
        model: the train, without mesh damping.
        tolerance: error of mesh forces relative to their mean.
        run: an EQUILIBRIUM; what it holds is the first guess.
        shown: (QUANTITIES, meshes), see `observe`.

    Raises:
        ValueError: there is no equilibrium, or it is not found.
    """
    kept = False
    for n in range(MOST_PASSES):
        shift = cycle_shift(model.train, run.state.x)
        if n < FREE_PASSES or not kept:
            _place(model, run)
        _torques(model, run)
        mean = _carry(model, run)
        _deflect(model, run)
        state, evaluation = run.state, run.evaluation
        observe(model, state, run.moment, state.x, state.v, 0.0, evaluation, shown)
        slack = tolerance * max(mean, LIGHTEST_FORCE)
        if n >= FREE_PASSES:
            slack = max(slack, DITHER)
        moved = abs(cycle_shift(model.train, state.x) - shift)
        kept = _keeps_sides(model.train, run, shown, slack)
        rests = kept and (moved <= PLACE * tolerance or n >= FREE_PASSES)
        if _rubs_as_before(model, run, shown, slack) and rests:
            _check_jump(model, run)
            _powers(model, run)
            return
        if n >= BRISK_PASSES:
            _rest_the_idle(model.train, run)
    raise ValueError(
        "dynamics = 'quasi_static': no static equilibrium is found, some planet has none between "
        "its flanks; soften the entry of teeth (mesh.ramp) or load the train more"
    )


@kernel
def _place(model: Record, run: Record) -> None:
    """Note stiffness, play and error of form of every mesh where it stands."""
    train, state, moment = model.train, run.state, run.moment
    rate = frame_cycle_rate(train, state)
    for i in range(train.meshes):
        if state.side[i] != OPEN:
            run.lean[i] = state.side[i]
        side = state.side[i] = run.lean[i]
        cycle = mesh_cycle(train, state, i, side)
        state.segment[i] = find_segment(
            train, train.kind[i], cycle, math.copysign(1.0, side * rate)
        )
    set_moment(model, state, moment)
    for i in range(train.meshes):
        run.error[i] = form_error(train, i, 0.0, moment.line_angle, 0.0, 0.0)[0]
        play = model.load.offset + radial_error(train, i, moment.line_angle, 0.0, 0.0)[0]
        carrying = DRIVE_PLAY if state.side[i] == DRIVE_SIDE else COAST_PLAY
        # Below zero only with a regulatory factor, whose forces grow from no deflection at all:
        # what a flank that does not carry stands off is positive.
        run.play[i, :] = abs(play)
        run.play[i, carrying] = play
        kind, gap = train.kind[i], 0.0
        k = mesh_stiffness(train, kind, state.segment[i], moment.start[i])
        if train.faults > 0:
            k, gap = _faulty_spring(model, run, i, k)
        run.stiffness[i] = k
        run.play[i, carrying] += gap


@kernel
def _faulty_spring(model: Record, run: Record, i: int, healthy: float) -> tuple[float, float]:
    """Stiffness [N/m] of the pairs of mesh i that carry, and their mean missing material [m]."""
    train, state, segment = model.train, run.state, run.state.segment[i]
    kind, side = train.kind[i], state.side[i]
    u = run.moment.start[i] - train.edge[kind, segment]
    squeeze = side * (mesh_motion(train, i, state.x) - run.error[i])
    squeeze -= run.play[i, DRIVE_PLAY if side == DRIVE_SIDE else COAST_PLAY]
    count = train.present[kind, segment]
    least = math.inf
    for p in range(count):
        least = min(least, fault_effect(train, run.moment, i, segment, p, u)[2])
    total = total_weight(train, kind, segment, u)[0]
    stiffness = moment = 0.0
    for p in range(count):
        factor, _, gap = fault_effect(train, run.moment, i, segment, p, u)
        if gap <= max(squeeze, least):
            weight = polynomial(train.weight, kind, segment, p, u, train.terms)[0]
            k = max(healthy * factor * weight / total, LEAST_STIFFNESS * healthy)
            stiffness += k
            moment += k * gap
    return stiffness, moment / stiffness


@kernel
def _torques(model: Record, run: Record) -> None:
    """Torques of the machines, and the forces on all bodies but those of the meshes."""
    train, load, state = model.train, model.load, run.state
    run.balance[:] = 0.0
    for j in range(train.bodies):
        speeding = 0.0
        for a in range(train.axes):
            speeding += train.ratio[j, a] * run.moment.slew[a]
        run.external[j] = run.evaluation.rubbing[j] - train.mass[j] * train.radius[j] * speeding
        for a in range(train.axes):
            run.balance[a] += train.ratio[j, a] * train.radius[j] * run.external[j]
    torque = load.torque[MOTOR]
    torque += load.ripple * math.sin(load.ripple_order * 2.0 * math.pi * state.fraction[0])
    for a in range(train.axes):
        torque += load.inertia[0, a] * run.moment.slew[a]
    run.torque[MOTOR] = torque
    loaded = train.coupling[LOAD_MACHINE, 0]
    run.torque[LOAD_MACHINE] = -(torque + run.balance[0]) / train.ratio[loaded, 0]
    if train.axes > 1:
        taken = train.ratio[loaded, 1] * run.torque[LOAD_MACHINE]
        run.torque[SECOND_MOTOR] = -(taken + run.balance[1])
    for c in range(train.machines):
        machine, member = train.coupling[c, 0], train.coupling[c, 1]
        run.external[machine] += run.torque[c] / train.radius[machine]
        run.external[member] += run.external[machine]


@kernel
def _carry(model: Record, run: Record) -> float:
    """Share the forces among the planets; their mean magnitude [N]."""
    train, springs, planets = model.train, run.springs, model.train.meshes // 2
    sun, ring = train.sun, train.body[planets, 1]
    total = run.external[sun] if sun != train.bodies else run.external[ring]
    for p in range(planets):
        s, r = p, planets + p
        springs.copies[p] = train.copies[p]
        rub = springs.rub[p] = run.external[train.body[p, 1]] / train.copies[p]
        springs.compliance[p] = 1.0 / run.stiffness[s] + 1.0 / run.stiffness[r]
        springs.error[p] = run.error[s] + run.error[r] + rub / run.stiffness[s]
        springs.steps[p, 0] = -run.play[s, COAST_PLAY] - run.play[r, COAST_PLAY]
        springs.steps[p, 2] = run.play[s, DRIVE_PLAY] + run.play[r, DRIVE_PLAY]
        if rub > 0.0:
            springs.steps[p, 1] = run.play[s, DRIVE_PLAY] - run.play[r, COAST_PLAY]
        else:
            springs.steps[p, 1] = run.play[r, DRIVE_PLAY] - run.play[s, COAST_PLAY]
        if sun != train.bodies:
            total -= train.copies[p] * rub
    w = share(total, planets, springs)
    for p in range(planets):
        run.force[planets + p] = planet_force(springs, p, w)[0]
        run.force[p] = run.force[planets + p] + springs.rub[p]
    for i in range(train.meshes):
        run.state.side[i] = OPEN
        if run.force[i] != 0.0:
            run.state.side[i] = DRIVE_SIDE if run.force[i] > 0.0 else COAST_SIDE
        if run.state.side[i] != run.moment.side[i]:
            take_segment(train, run.state, run.moment, i)
    _wind(train, run, w)
    return abs(total) / np.sum(train.copies[:planets])


@kernel
def _wind(train: Record, run: Record, w: float) -> None:
    """Let couplings and members yield; w [m] is what the ring stands behind the sun."""
    x, planets = run.state.x, train.meshes // 2
    loaded = train.coupling[LOAD_MACHINE, 1]
    x[loaded] = 0.0
    for c in range(0, train.machines, 2):  # the motors stay where their frame is
        machine, member = train.coupling[c, 0], train.coupling[c, 1]
        x[member] = -run.external[machine] / train.coupling_stiffness[c]
    x[train.bodies] = 0.0
    wound = x[train.sun] + x[train.body[planets, 1]] - 2.0 * x[train.carrier]
    x[loaded] = (w - wound) / (-2.0 if loaded == train.carrier else 1.0)


@law
def _stretch(run: Record, i: int) -> float:
    """d [m] of a mesh that carries its force."""
    play = run.play[i, DRIVE_PLAY] if run.force[i] > 0.0 else -run.play[i, COAST_PLAY]
    return run.error[i] + play + run.force[i] / run.stiffness[i]


@kernel
def _deflect(model: Record, run: Record) -> None:
    """Put every planet where its meshes carry their forces, and an idle one amid its play."""
    train, x, planets = model.train, run.state.x, model.train.meshes // 2
    sun, ring, carrier = x[train.sun], x[train.body[planets, 1]], x[train.carrier]
    for p in range(planets):
        s, r = p, planets + p
        if run.force[s] != 0.0:
            d = _stretch(run, s)
        elif run.force[r] != 0.0:
            d = sun + ring - 2.0 * carrier - _stretch(run, r)
        else:
            low, high = run.springs.steps[p, 0], run.springs.steps[p, 2]
            passed = sun + ring - 2.0 * carrier - run.springs.error[p] - low
            passed = passed / (high - low) if high > low else 0.0
            both = run.play[s, DRIVE_PLAY] + run.play[s, COAST_PLAY]
            d = run.error[s] - run.play[s, COAST_PLAY] + passed * both
        x[train.body[p, 1]] = d - sun + carrier


@kernel
def _keeps_sides(train: Record, run: Record, shown: np.ndarray, slack: float) -> bool:
    """Whether stiffness and play were those of the sides and tooth pairs that carry now."""
    for i in range(train.meshes):
        if abs(run.force[i]) > slack and run.state.side[i] != run.lean[i]:
            return False
        if abs(shown[MESH_FORCE, i] - run.force[i]) > slack:
            return False
    return True


@kernel
def _rubs_as_before(model: Record, run: Record, shown: np.ndarray, slack: float) -> bool:
    """Whether friction and drag of these forces are those the forces were found with."""
    evaluation, still = run.evaluation, True
    copy_array(run.before, evaluation.rubbing)
    evaluation.power[:] = 0.0
    for i in range(model.train.meshes):
        evaluation.now.push[i] = abs(run.force[i])
    rub(model, run.state, run.moment, run.state.v, evaluation)
    for j in range(model.train.bodies):
        change = abs(evaluation.rubbing[j] - run.before[j])
        still = still and change <= slack * model.train.body_copies[j]
    return still


@kernel
def _rest_the_idle(train: Record, run: Record) -> None:
    """Guess what rubs anew: nothing where its sense has just changed, else midway.

    The friction of a light load is large beside it, so an idle planet is thrown from flank to
    flank, pass by pass, while it is at rest amid its play.
    """
    for j in range(train.bodies):
        now, before = run.evaluation.rubbing[j], run.before[j]
        run.evaluation.rubbing[j] = 0.0 if now * before < 0.0 else 0.5 * (now + before)


@kernel
def _check_jump(model: Record, run: Record) -> None:
    """A force that jumps where flanks meet cannot carry less than its jump at rest."""
    load = model.load
    if load.half_backlash == load.offset:
        return
    for i in range(model.train.meshes):
        side = run.state.side[i]
        d = mesh_motion(model.train, i, run.state.x) - run.error[i]
        radial = radial_error(model.train, i, run.moment.line_angle, 0.0, 0.0)[0]
        if side != OPEN and side * d - radial < load.half_backlash:
            raise ValueError(
                "mesh.backlash = 'regulatory_factor': without dynamics every mesh must carry "
                "more than its stiffness times the backlash"
            )


@kernel
def _powers(model: Record, run: Record) -> None:
    """Let the machines balance the friction that has been found; book what they give."""
    _torques(model, run)
    train, power = model.train, run.evaluation.power
    for c in range(train.machines):
        machine = train.coupling[c, 0]
        speed = body_speed(train, run.state, run.state.v, machine)
        power[WORK + c] = run.torque[c] * speed
        power[IMPULSE + c] = run.torque[c]
