"""One step of exponential collocation in the modes of the contact state.

M x'' = F(t, x, v) is written as q'' + c q' + w^2 q = rest in the modes of the meshes that are in
contact; all that is not linear, diagonal and constant is left to the rest: friction, damping out
of proportion, stiffness that changes within a segment, errors of form, machines. A polynomial
through the rest at the Lobatto points of the step is answered exactly (`oscillator`), and the rest
is taken anew at what comes out, until that moves no more. So the step is as long as the *rest*
is smooth, whatever the meshes do: exponential integrators of collocation type, Hochbruck and
Ostermann 2010, Exponential integrators, Acta Numerica 19, section 2.
"""

from __future__ import annotations

import math

import numpy as np

from .._compile import kernel, law
from .._records import AXES, BODIES, MESHES, REAL, SMALL, WHOLE, Record, layout
from ..dynamics.contact_events import departure, play_left
from ..dynamics.cycle import cycle_shift
from ..dynamics.equations import EVALUATION, begin_pairs, drive, rub, squeeze
from ..dynamics.state import LEDGER, OPEN
from ..dynamics.tooth_friction import INSTANTS, evaluate
from .contact_modes import CONTACT_MODES, find_modes
from .radau import radau
from .oscillator import SERIES, is_slow, wave

# Radau's points: the end of the step is one of them, the start is not.
NODES = INSTANTS
ABSCISSA = radau(NODES)
LAST = NODES - 1
# Coefficients of the powers of t/h from values at the nodes.
WIDEST = float(np.diff(np.append(0.0, ABSCISSA)).max())  # gap between two
SCANNED = 8  # times at which a suspect mesh is looked at
MOST_SWEEPS = 6
SHARE = 0.3  # of the tolerance that a sweep not made may leave
COEFFICIENT = np.linalg.inv(np.vander(ABSCISSA, increasing=True))

# One of the nodes.
NODE = layout(
    delay=REAL,  # [s]
    advance=REAL,  # mesh cycles since the start
    pace=REAL,  # mesh cycles per second
    x=(REAL, (BODIES,)),
    v=(REAL, (BODIES,)),
    trim=(REAL, (AXES,)),
)

# A step in the making, and what its dense output reads.
PROPAGATION = layout(
    known=CONTACT_MODES,
    modes=WHOLE,  # place in `known`
    start=(REAL, (BODIES,)),  # `rest` to begin with
    step=REAL,  # [s]
    square=(REAL, (BODIES,)),  # w^2 [1/s^2]
    damping=(REAL, (BODIES,)),  # c [1/s]
    q=(REAL, (BODIES,)),  # at the start [m sqrt(kg)]
    p=(REAL, (BODIES,)),  # q' at the start
    rest=(REAL, (NODES, BODIES)),  # [m sqrt(kg)/s^2]
    slow=(WHOLE, (BODIES,)),
    particular=(REAL, (SERIES, BODIES)),  # of powers of t/h
    free=(REAL, (2, BODIES)),  # q and q' of the free motion at the start
    cosine=(REAL, (NODES, BODIES)),  # `wave` at the nodes
    sine=(REAL, (NODES, BODIES)),
    node_q=(REAL, (NODES, BODIES)),
    node_p=(REAL, (NODES, BODIES)),
    wave_q=(REAL, (NODES, BODIES)),  # free motion at the nodes
    wave_p=(REAL, (NODES, BODIES)),
    suspect=(SMALL, (MESHES,)),  # may change its contact within the step
    scan_q=(REAL, (SCANNED, BODIES)),
    scan_p=(REAL, (SCANNED, BODIES)),
    now_q=(REAL, (BODIES,)),
    now_p=(REAL, (BODIES,)),
    power=(REAL, (NODES, LEDGER)),
    node=(NODE, (NODES,)),
    evaluation=(EVALUATION, (NODES,)),  # the pairs of all are in the first
)


@kernel
def enter(model: Record, march: Record) -> None:
    """Express the start of a step in the modes of its contacts."""
    train, begin, moment, run = model.train, march.begin, march.moment, march.run
    known = run.known
    n = find_modes(train, begin, known)
    run.modes = n
    for m in range(train.bodies):
        damping = known.shaft_damping[n, m]
        for i in range(train.meshes):
            k = known.stiffness[n, i]
            damping += moment.tau[train.kind[i]] * k * known.motion[n, i, m] ** 2
        q = p = force = 0.0
        for j in range(train.bodies):
            shape = known.form[n, j, m]
            q += shape * train.mass[j] * begin.x[j]
            p += shape * train.mass[j] * begin.v[j]
            force += shape * march.first.force[j]
        square = known.square[n, m]
        run.square[m], run.damping[m], run.q[m], run.p[m] = square, damping, q, p
        run.start[m] = force + damping * p + square * q


@kernel
def _set_step(run: Record, bodies: int, h: float) -> None:
    """Free motions of all modes at the nodes of a step of h."""
    run.step = h
    for m in range(bodies):
        run.slow[m] = is_slow(run.square[m], run.damping[m], h)
        if run.slow[m] == 0:
            for n in range(NODES):
                cosine, sine = wave(run.square[m], run.damping[m], ABSCISSA[n] * h)
                run.cosine[n, m], run.sine[n, m] = cosine, sine


@kernel
def _respond(run: Record, bodies: int) -> None:
    """The motion of all modes under the polynomial through `rest`."""
    h = run.step
    for m in range(bodies):
        square, damping = run.square[m], run.damping[m]
        a = run.particular
        for k in range(NODES):
            value = 0.0
            for n in range(NODES):
                value += COEFFICIENT[k, n] * run.rest[n, m]
            a[k, m] = value
        if run.slow[m] == 1:
            stiff, loss = square * h * h, damping * h
            for k in range(NODES, SERIES):
                a[k, m] = 0.0
            for k in range(SERIES - 3, -1, -1):  # make room for the first two
                a[k + 2, m] = h * h * a[k, m]
            a[0, m], a[1, m] = run.q[m], h * run.p[m]
            for k in range(SERIES - 2):
                inner = a[k + 2, m] - loss * (k + 1) * a[k + 1, m] - stiff * a[k, m]
                a[k + 2, m] = inner / ((k + 1) * (k + 2))
        else:
            loss, inertia = damping / h, 1.0 / (h * h)
            above = beyond = 0.0
            for k in range(NODES - 1, -1, -1):
                value = a[k, m] - (k + 1) * (loss * above + (k + 2) * inertia * beyond)
                above, beyond = value / square, above
                a[k, m] = above
            run.free[0, m] = run.q[m] - a[0, m]
            run.free[1, m] = run.p[m] - a[1, m] / h


@law
def _modal_state(run: Record, m: int, t: float, cosine: float, sine: float) -> tuple[float, float]:
    """q and q' of mode m at t/h, with `wave` at that time where it is fast."""
    a, value, slope = run.particular, 0.0, 0.0
    if run.slow[m] == 1:
        for k in range(SERIES - 1, -1, -1):
            slope = slope * t + value
            value = value * t + a[k, m]
        return value, slope / run.step
    for k in range(NODES - 1, -1, -1):
        slope = slope * t + value
        value = value * t + a[k, m]
    u, w = run.free[0, m], run.free[1, m]
    value += cosine * u + sine * w
    slope /= run.step
    slope += (cosine - run.damping[m] * sine) * w - run.square[m] * sine * u
    return value, slope


@kernel
def _place(train: Record, run: Record, x: np.ndarray, v: np.ndarray) -> None:
    """x and v of the bodies from the modes."""
    known, n, bodies = run.known, run.modes, train.bodies
    for j in range(bodies):
        place = pace = 0.0
        for m in range(bodies):
            place += known.form[n, j, m] * run.now_q[m]
            pace += known.form[n, j, m] * run.now_p[m]
        x[j], v[j] = place, pace


@kernel
def propagate(model: Record, march: Record, delay: float, x: np.ndarray, v: np.ndarray) -> None:
    """x and v at any time within the step."""
    train, run = model.train, march.run
    for m in range(train.bodies):
        cosine = sine = 0.0
        if run.slow[m] == 0:
            cosine, sine = wave(run.square[m], run.damping[m], delay)
        run.now_q[m], run.now_p[m] = _modal_state(run, m, delay / run.step, cosine, sine)
    _place(train, run, x, v)


@kernel
def trim_at(model: Record, march: Record, delay: float, x: np.ndarray, trim: np.ndarray) -> None:
    """Trim of the speed loops, the integral of set-point minus speed."""
    train, begin, moment = model.train, march.begin, march.moment
    for a in range(train.axes):
        motor = train.coupling[2 * a, 0]
        lag = begin.set_speed[a] - begin.speed[a] + 0.5 * moment.slew[a] * delay
        trim[a] = begin.trim[a] + lag * delay - (x[motor] - begin.x[motor]) / train.radius[motor]


@kernel
def _press_again(model: Record, march: Record) -> None:
    """Take the rest anew at all nodes, while friction stays what it is."""
    train, begin, moment, run = model.train, march.begin, march.moment, march.run
    pairs = run.evaluation[0].pairs
    for n in range(NODES):
        node, out = run.node[n], run.evaluation[n]
        _visit(model, march, n, node)
        begin_pairs(train, False, pairs)
        squeeze(model, begin, moment, node.x, node.v, node.delay, out, pairs)
        out.force[:] += out.rubbing
        _rest(model, march, n, node, out)


@kernel
def _sweep(model: Record, march: Record) -> None:
    """Take the rest anew at all nodes."""
    train, begin, moment, run = model.train, march.begin, march.moment, march.run
    pairs = run.evaluation[0].pairs
    begin_pairs(train, train.friction, pairs)
    for n in range(NODES):
        node = run.node[n]
        _visit(model, march, n, node)
        squeeze(model, begin, moment, node.x, node.v, node.delay, run.evaluation[n], pairs)
    if train.friction:
        evaluate(model, pairs)
    for n in range(NODES):
        node, out = run.node[n], run.evaluation[n]
        rub(model, begin, node.v, out, pairs)
        _rest(model, march, n, node, out)
        run.power[n] = out.power


@kernel
def _rest(model: Record, march: Record, n: int, node: Record, out: Record) -> None:
    """What the modes do not know of the forces at node n."""
    train, run, shape = model.train, march.run, march.run.known.form
    drive(model, march.begin, march.moment, node.x, node.v, node.delay, node.trim, out)
    for m in range(train.bodies):
        force = run.damping[m] * run.node_p[n, m] + run.square[m] * run.node_q[n, m]
        for j in range(train.bodies):
            force += shape[run.modes, j, m] * out.force[j]
        run.rest[n, m] = force


@kernel
def _visit(model: Record, march: Record, n: int, node: Record) -> None:
    """Where the response stands at node n."""
    train, run = model.train, march.run
    node.delay = ABSCISSA[n] * run.step
    for m in range(train.bodies):
        cosine, sine = run.cosine[n, m], run.sine[n, m]
        run.now_q[m], run.now_p[m] = _modal_state(run, m, ABSCISSA[n], cosine, sine)
        run.node_q[n, m], run.node_p[n, m] = run.now_q[m], run.now_p[m]
    _place(train, run, node.x, node.v)
    trim_at(model, march, node.delay, node.x, node.trim)
    shift = cycle_shift(train, node.x) - cycle_shift(train, march.begin.x)
    node.advance = march.moment.cycle_rate * node.delay + shift
    node.pace = march.moment.cycle_rate + cycle_shift(train, node.v)


@kernel
def iterate(model: Record, march: Record, h: float) -> float:
    """Try a step of h into `end`; its error over what is allowed."""
    train, run, end = model.train, march.run, march.end
    _set_step(run, train.bodies, h)
    for n in range(NODES):
        run.rest[n] = run.start
        run.evaluation[n].rubbing[:] = march.first.rubbing
    _respond(run, train.bodies)
    known, modes, change, tail = run.known, run.modes, math.inf, 0.0
    if known.varies[modes] == 1:
        for sweep in range(MOST_SWEEPS):
            before = change
            _press_again(model, march)
            change = _move_on(model, march)
            if sweep > 0 and before > 0.0:
                known.pull[modes, 0] = change / before / h
            if change * known.pull[modes, 0] * h <= SHARE:
                break
    change = math.inf
    for sweep in range(MOST_SWEEPS):
        before = change
        _sweep(model, march)
        march.control.evaluations += NODES
        change = _move_on(model, march)
        if sweep == 0:
            tail = _tail(model, march)
        else:
            known.pull[modes, 1] = change / before / h if before > 0.0 else 0.0
        if tail > 1.0 or change * known.pull[modes, 1] * h <= SHARE:
            break
    return max(tail, change * known.pull[modes, 1] * h)


@kernel
def integrate_powers(march: Record, h: float) -> None:
    """Fill the ledger at h seconds into the step."""
    run, end = march.run, march.end
    end.energy[:] = march.begin.energy
    t = h / run.step
    for n in range(NODES):
        weight, u = 0.0, 1.0
        for k in range(NODES):
            u *= t
            weight += COEFFICIENT[k, n] * u / (k + 1)
        for e in range(LEDGER):
            end.energy[e] += run.step * weight * run.power[n, e]


@kernel
def _move_on(model: Record, march: Record) -> float:
    """Answer the rest as it is now; how far that moves the end of the step, over its tolerance."""
    train, run, end = model.train, march.run, march.end
    _respond(run, train.bodies)
    for m in range(train.bodies):
        cosine, sine = run.cosine[LAST, m], run.sine[LAST, m]
        run.now_q[m], run.now_p[m] = _modal_state(run, m, 1.0, cosine, sine)
    _place(train, run, end.x, end.v)
    return _difference(model, march)


@kernel
def _difference(model: Record, march: Record) -> float:
    """Largest motion of a mesh between the last sweep and the one before, over its tolerance."""
    train, last, end = model.train, march.run.node[LAST], march.end
    largest = 0.0
    for i in range(train.meshes):
        d = rate = 0.0
        for a in range(3):
            j = train.body[i, a]
            d += train.sign[i, a] * (end.x[j] - last.x[j])
            rate += train.sign[i, a] * (end.v[j] - last.v[j])
        largest = max(largest, abs(d), march.moment.tau[train.kind[i]] * abs(rate))
    return largest / march.control.tolerance_x


@kernel
def _tail(model: Record, march: Record) -> float:
    """Local error, what the highest power of the polynomial moves, over its tolerance."""
    train, run, largest = model.train, march.run, 0.0
    h, n = run.step, run.modes
    for m in range(train.bodies):
        tail = 0.0
        for k in range(NODES):
            tail += COEFFICIENT[LAST, k] * run.rest[k, m]
        run.now_q[m] = abs(tail) * 0.048 * min(1.0 / max(run.square[m], 1e-300), h * h / 40.0)
    for i in range(train.meshes):
        total = 0.0
        for m in range(train.bodies):
            total += abs(run.known.motion[n, i, m]) * run.now_q[m]
        largest = max(largest, total)
    return largest / march.control.tolerance_x


@kernel
def suspect_flanks(model: Record, march: Record) -> bool:
    """Mark the meshes that may change their contact within the step; whether there are any.

    What a mesh has left before it changes is a polynomial, known at the nodes, and free waves,
    which are bounded by their amplitudes.
    """
    train, begin, moment, run = model.train, march.begin, march.moment, march.run
    known, modes, found = run.known, run.modes, False
    for n in range(NODES):
        for m in range(train.bodies):
            run.wave_q[n, m] = run.wave_p[n, m] = 0.0
            if run.slow[m] == 0:
                u, w, c, s = run.free[0, m], run.free[1, m], run.cosine[n, m], run.sine[n, m]
                run.wave_q[n, m] = c * u + s * w
                run.wave_p[n, m] = (c - run.damping[m] * s) * w - run.square[m] * s * u
    for i in range(train.meshes):
        side, tau = begin.side[i], model.load.release * moment.tau[train.kind[i]]
        waves, least = 0.0, math.inf
        for m in range(train.bodies):
            if run.slow[m] == 0:
                waves += abs(known.motion[modes, i, m]) * _amplitude(run, m, tau)
        for n in range(NODES):
            node, wave = run.node[n], 0.0
            for m in range(train.bodies):
                wave += known.motion[modes, i, m] * (run.wave_q[n, m] + tau * run.wave_p[n, m])
            stand = (node.advance, node.pace, 0.0)
            left = departure(model, begin, moment, i, node.x, node.v, stand)
            least = min(least, left - (side * wave if side != OPEN else abs(wave)))
        run.suspect[i] = least < waves
        found |= least < waves
    return found


@kernel
def scan(model: Record, march: Record, end: float) -> None:
    """Modes at even times up to `end` [s]; free motions are carried on from one to the next."""
    run, step = march.run, end / SCANNED
    for m in range(model.train.bodies):
        cosine = sine = 0.0
        u, w = run.free[0, m], run.free[1, m]
        if run.slow[m] == 0:
            cosine, sine = wave(run.square[m], run.damping[m], step)
        for k in range(SCANNED):
            t = (k + 1) * step / run.step
            value = slope = 0.0
            terms = SERIES if run.slow[m] == 1 else NODES
            for n in range(terms - 1, -1, -1):
                slope = slope * t + value
                value = value * t + run.particular[n, m]
            slope /= run.step
            if run.slow[m] == 0:
                u, w = (
                    cosine * u + sine * w,
                    (cosine - run.damping[m] * sine) * w - run.square[m] * sine * u,
                )
                value += u
                slope += w
            run.scan_q[k, m], run.scan_p[k, m] = value, slope


@kernel
def first_scanned(model: Record, march: Record, i: int, slack: float) -> int:
    """Number of the first of the scanned times at which mesh i has changed, or SCANNED."""
    train, run = model.train, march.run
    tau = march.moment.tau[train.kind[i]]
    for k in range(SCANNED):
        d = rate = 0.0
        for m in range(train.bodies):
            motion = run.known.motion[run.modes, i, m]
            d += motion * run.scan_q[k, m]
            rate += motion * run.scan_p[k, m]
        if play_left(model.load, march.begin.side[i], d, tau * rate, slack) < 0.0:
            return k
    return SCANNED


@kernel
def play_at(model: Record, march: Record, i: int, delay: float, slack: float) -> float:
    """`departure` of mesh i at any time within the step, where no error of form moves its flanks."""
    train, run, moment = model.train, march.run, march.moment
    d = rate = 0.0
    for m in range(train.bodies):
        motion = run.known.motion[run.modes, i, m]
        cosine = sine = 0.0
        if run.slow[m] == 0:
            cosine, sine = wave(run.square[m], run.damping[m], delay)
        q, p = _modal_state(run, m, delay / run.step, cosine, sine)
        d += motion * q
        rate += motion * p
    tau = moment.tau[train.kind[i]]
    return play_left(model.load, march.begin.side[i], d, tau * rate, slack)


@law
def _amplitude(run: Record, m: int, tau: float) -> float:
    """Bound on the free motion of mode m and tau times its rate, together."""
    w = math.sqrt(run.square[m])
    half = 0.5 * run.damping[m]
    split = run.square[m] - half * half
    # From (1, 0): C - tau w^2 S; from (0, 1): S + tau (C - c S); S never exceeds 1/w, nor C 1.
    longest = 1.0 / w if split <= 0.0 else min(1.0 / w, 1.0 / math.sqrt(split))
    first = 1.0 + abs(half - tau * run.square[m]) * longest
    if split > 0.0:
        ratio = (half - tau * run.square[m]) / math.sqrt(split)
        first = min(first, math.sqrt(1.0 + ratio * ratio))
    return first * abs(run.free[0, m]) + (longest + tau) * abs(run.free[1, m])
