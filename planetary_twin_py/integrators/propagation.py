"""A step whose meshes move exactly, under a polynomial for all that is not linear.

M x'' = F(t, x, v) reads q'' + c q' + w^2 q = rest in the modes of the meshes in contact. The rest
is friction, machines, errors of form, damping out of proportion, stiffness that changes within
its segment; a polynomial through its values at the nodes of the step is answered exactly, at the
nodes and at any time between them: by a polynomial and a free wave. A mode that hardly moves of
its own within the step counts as a free mass, its spring and damper as part of the rest.
"""

from __future__ import annotations

import numpy as np

from .._combine import combine, combine_both
from .._compile import kernel, law
from .._overwrite import copy_array
from .._records import AXES, BODIES, MESHES, REAL, SMALL, WHOLE, Record, layout
from ..dynamics.equations import EVALUATION
from ..dynamics.state import DAMPING, LEDGER
from .contact_modes import CONTACT_MODES, find_modes
from .oscillator import decay_rates, is_free, wave
from .radau import MOST, NODES

POWERS = MOST + 2  # of t/h in the motion of a free mass
LONGEST_MEMORY = 1e3  # c/(w^2 h) of a mode whose motion keeps ten digits
SLOWEST_SWING = 30.0  # (1 + c h)/(w h)^2, to whose fourth power digits are lost
SCANNED = 8  # times at which flanks are looked at

# How all modes move within a step: what dense output reads. q is in m sqrt(kg).
MOTION = layout(
    modes=WHOLE,  # place in `known`
    step=REAL,  # [s]
    square=(REAL, (BODIES,)),  # w^2 [1/s^2]
    damping=(REAL, (BODIES,)),  # c [1/s]
    rate=(REAL, (BODIES,)),  # see `oscillator.decay_rates`
    slow=(REAL, (BODIES,)),
    fast=(REAL, (BODIES,)),
    particular=(REAL, (POWERS, BODIES)),  # motion under the polynomial, of powers of t/h
    free=(REAL, (2, BODIES)),  # q and q' of the free motion at the start
)

# A step in the making.
PROPAGATION = layout(
    nodes=NODES,
    known=CONTACT_MODES,
    motion=MOTION,
    spring=(REAL, (BODIES,)),  # w^2 and c, but 0 for what counts as a free mass
    damper=(REAL, (BODIES,)),
    q=(REAL, (BODIES,)),  # at the start
    p=(REAL, (BODIES,)),  # q' at the start
    force=(REAL, (BODIES,)),  # at the start, friction being as it was before
    rest=(REAL, (MOST, BODIES)),  # at the nodes
    cosine=(REAL, (MOST, BODIES)),  # `wave` at the nodes
    sine=(REAL, (MOST, BODIES)),
    node_q=(REAL, (MOST, BODIES)),
    node_p=(REAL, (MOST, BODIES)),
    node_x=(REAL, (MOST, BODIES)),
    node_v=(REAL, (MOST, BODIES)),
    node_trim=(REAL, (MOST, AXES)),
    node_d=(REAL, (MOST, MESHES)),
    node_rate=(REAL, (MOST, MESHES)),
    before_d=(REAL, (MESHES,)),  # at the last node, one sweep earlier
    before_rate=(REAL, (MESHES,)),
    before_v=(REAL, (BODIES,)),
    evaluation=(EVALUATION, (MOST,)),
    now_q=(REAL, (BODIES,)),  # room to work in
    now_p=(REAL, (BODIES,)),
    now_d=(REAL, (MESHES,)),
    now_rate=(REAL, (MESHES,)),
    suspect=(SMALL, (MESHES,)),  # may change its contact within the step
    least=(REAL, (MESHES,)),
    scan_d=(REAL, (SCANNED, MESHES)),  # at even times
    scan_rate=(REAL, (SCANNED, MESHES)),
)


@kernel
def enter(model: Record, march: Record) -> None:
    """Express the start of a step in the modes of its contacts."""
    train, begin, moment, run = model.train, march.begin, march.moment, march.run
    known, lanes = run.known, train.lanes
    n = find_modes(train, begin, known)
    run.motion.modes = n
    for m in range(lanes):
        damping = known.shaft_damping[n, m] + moment.tau[0] * known.mesh_damping[n, 0, m]
        damping += moment.tau[1] * known.mesh_damping[n, 1, m]
        square = known.square[n, m]
        run.motion.square[m], run.motion.damping[m] = square, damping
        run.motion.rate[m], run.motion.slow[m], run.motion.fast[m] = decay_rates(square, damping)
        run.now_q[m], run.now_p[m] = train.mass[m] * begin.x[m], train.mass[m] * begin.v[m]
    share = known.share[n]
    combine_both(share, run.now_q, run.now_p, train.bodies, run.q, run.p)
    combine(share, march.first.force, train.bodies, run.force)


@law
def wave_of(motion: Record, m: int, t: float) -> tuple[float, float]:
    """`wave` of mode m."""
    return wave(motion.damping[m], motion.rate[m], motion.slow[m], motion.fast[m], t)


@kernel
def set_step(run: Record, lanes: int, h: float) -> None:
    """Free motions of all modes at the nodes of a step of h, and the rest as it is at the start."""
    run.motion.step = h
    for m in range(lanes):
        free = is_free(run.motion.square[m], run.motion.damping[m], h)
        run.spring[m] = 0.0 if free else run.motion.square[m]
        run.damper[m] = 0.0 if free else run.motion.damping[m]
    for n in range(run.nodes.count):
        t = run.nodes.abscissa[n] * h
        for m in range(lanes):
            first, second = wave_of(run.motion, m, t)
            run.cosine[n, m], run.sine[n, m] = first, second
            rest = run.force[m] + run.damper[m] * run.p[m] + run.spring[m] * run.q[m]
            run.rest[n, m] = rest


@kernel
def resolves(run: Record, bodies: int, h: float) -> bool:
    """Whether a step of h keeps its digits.

    A mode that creeps for much longer than the step is a small difference of a polynomial and a
    wave, both larger by the square of that ratio.
    """
    for m in range(bodies):
        square, damping = run.motion.square[m], run.motion.damping[m]
        if not is_free(square, damping, h) and damping > LONGEST_MEMORY * square * h:
            return False
    return True


@law
def power(run: Record, k: int, m: int) -> float:
    """Coefficient of (t/h)^k in the polynomial through the rest of mode m."""
    c, rest = run.nodes.coefficient, run.rest
    low = c[k, 0] * rest[0, m] + c[k, 1] * rest[1, m] + c[k, 2] * rest[2, m]
    return low + c[k, 3] * rest[3, m] + c[k, 4] * rest[4, m]


@law
def respond(run: Record, lanes: int) -> None:
    """The motion of all modes under the polynomial through `rest`."""
    h = run.motion.step
    square, inertia = h * h, 1.0 / (h * h)
    for m in range(lanes):
        spring, loss = run.spring[m], run.damper[m] / h
        free = spring + loss == 0.0
        inverse = 1.0 / (1.0 if free else spring)
        a, b, c = power(run, 0, m), power(run, 1, m), power(run, 2, m)
        d, e = power(run, 3, m), power(run, 4, m)
        # w^2 y_k + (k + 1) c/h y_(k+1) + (k + 1) (k + 2)/h^2 y_(k+2) is the rest's coefficient.
        four = e * inverse
        three = (d - 4.0 * loss * four) * inverse
        two = (c - 3.0 * loss * three - 12.0 * inertia * four) * inverse
        one = (b - 2.0 * loss * two - 6.0 * inertia * three) * inverse
        zero = (a - loss * one - 2.0 * inertia * two) * inverse
        q, p = run.q[m], run.p[m]
        run.motion.particular[0, m] = q if free else zero
        run.motion.particular[1, m] = h * p if free else one
        run.motion.particular[2, m] = square / 2.0 * a if free else two
        run.motion.particular[3, m] = square / 6.0 * b if free else three
        run.motion.particular[4, m] = square / 12.0 * c if free else four
        run.motion.particular[5, m] = square / 20.0 * d if free else 0.0
        run.motion.particular[6, m] = square / 30.0 * e if free else 0.0
        run.motion.free[0, m] = 0.0 if free else q - zero
        run.motion.free[1, m] = 0.0 if free else p - one / h


@law
def modal_state(
    run: Record, m: int, t: float, per_step: float, cosine: float, sine: float
) -> tuple[float, float]:
    """q and q' of mode m at t/h, from `wave` at that time and 1/h."""
    y = run.motion.particular
    a, b, c, d = y[0, m], y[1, m], y[2, m], y[3, m]
    e, f, g = y[4, m], y[5, m], y[6, m]
    u, w = run.motion.free[0, m], run.motion.free[1, m]
    value = a + t * (b + t * (c + t * (d + t * (e + t * (f + t * g)))))
    slope = b + t * (2.0 * c + t * (3.0 * d + t * (4.0 * e + t * (5.0 * f + t * 6.0 * g))))
    rate = (cosine - run.motion.damping[m] * sine) * w - run.motion.square[m] * sine * u
    return value + cosine * u + sine * w, slope * per_step + rate


@law
def modes_at(run: Record, lanes: int, delay: float) -> None:
    """q and q' of all modes at any time within the step, in `now_q` and `now_p`."""
    t, per_step = delay / run.motion.step, 1.0 / run.motion.step
    for m in range(lanes):
        first, second = wave_of(run.motion, m, delay)
        run.now_q[m], run.now_p[m] = modal_state(run, m, t, per_step, first, second)


@kernel
def propagate(model: Record, march: Record, delay: float, x: np.ndarray, v: np.ndarray) -> None:
    """x and v at any time within the step."""
    train, run = model.train, march.run
    modes_at(run, train.lanes, delay)
    form = run.known.form[run.motion.modes]
    combine_both(form, run.now_q, run.now_p, train.bodies, x, v)


@kernel
def trim_at(model: Record, march: Record, delay: float, x: np.ndarray, trim: np.ndarray) -> None:
    """Trim of the speed loops, the integral of set-point minus speed."""
    train, begin, moment = model.train, march.begin, march.moment
    for a in range(train.axes):
        motor = train.coupling[2 * a, 0]
        lag = begin.set_speed[a] - begin.speed[a] + 0.5 * moment.slew[a] * delay
        turned = (x[motor] - begin.x[motor]) * train.inverse_radius[motor]
        trim[a] = begin.trim[a] + lag * delay - turned


@kernel
def visit_nodes(model: Record, march: Record) -> None:
    """Answer the rest as it is now, and move on to where that takes the nodes."""
    train, run = model.train, march.run
    lanes, bodies, per_step = train.lanes, train.bodies, 1.0 / run.motion.step
    respond(run, lanes)
    nodes, last = run.nodes, run.nodes.count - 1
    for i in range(lanes):
        run.before_d[i], run.before_rate[i] = run.node_d[last, i], run.node_rate[last, i]
        run.before_v[i] = run.node_v[last, i]
    form, motion = run.known.form[run.motion.modes], run.known.motion[run.motion.modes]
    for n in range(nodes.count):
        t, q, p = nodes.abscissa[n], run.node_q[n], run.node_p[n]
        for m in range(lanes):
            q[m], p[m] = modal_state(run, m, t, per_step, run.cosine[n, m], run.sine[n, m])
        combine_both(form, q, p, bodies, run.node_x[n], run.node_v[n])
        combine_both(motion, q, p, bodies, run.node_d[n], run.node_rate[n])
        trim_at(model, march, t * run.motion.step, run.node_x[n], run.node_trim[n])


@kernel
def integrate_powers(march: Record, lanes: int, h: float) -> None:
    """Fill the ledger at h seconds into the step.

    By quadrature at the nodes; what damping takes from modes that swing is known exactly.
    """
    run, end = march.run, march.end
    copy_array(end.energy, march.begin.energy)
    t, last, lost = h / run.motion.step, run.nodes.count - 1, 0.0
    for n in range(run.nodes.count):
        weight, u = 0.0, run.motion.step
        for k in range(run.nodes.count):
            u *= t
            weight += run.nodes.coefficient[k, n] * u / (k + 1)
        for e in range(LEDGER):
            end.energy[e] += weight * run.evaluation[n].power[e]
        for m in range(lanes):
            damped = weight * run.motion.damping[m] * run.node_p[n, m] ** 2
            lost -= damped if _swings(run, m) else 0.0
    for m in range(lanes):
        first, second = run.cosine[last, m], run.sine[last, m]
        if h != run.motion.step:
            first, second = wave_of(run.motion, m, h)
        lost += _damped(run, m, h, first, second) if _swings(run, m) else 0.0
    end.energy[DAMPING] += lost


@law
def _swings(run: Record, m: int) -> bool:
    """Whether a mode has free waves, of which quadrature might miss what is damped.

    Not those that hardly move within the step: `_damped` would lose all its digits, quadrature
    none.
    """
    stiff, loss = run.spring[m] * run.motion.step * run.motion.step, run.damper[m] * run.motion.step
    return loss > 0.0 and 1.0 + loss < SLOWEST_SWING * stiff


@law
def _damped(run: Record, m: int, h: float, first: float, second: float) -> float:
    """Integral of c q'^2 over h seconds for a mode that swings, with `wave` at its end [J].

    q' is a polynomial y'(t) and the rate of a free motion u. By itself that loses c int u'^2, the
    energy (u'^2 + w^2 u^2)/2 it has less at the end; int t^k u' and int t^k u follow from each
    other by u'' + c u' + w^2 u = 0.
    """
    c, square = run.motion.damping[m], run.motion.square[m]
    u0, w0 = run.motion.free[0, m], run.motion.free[1, m]
    u1, w1 = first * u0 + second * w0, (first - c * second) * w0 - square * second * u0
    lost = 0.5 * (w0 * w0 - w1 * w1 + square * (u0 * u0 - u1 * u1))
    # y' = (a + b s + d s^2 + e s^3)/h with s = t/h, from 0 to `part`
    step, part, y = run.motion.step, h / run.motion.step, run.motion.particular
    a, b, d, e = y[1, m], 2.0 * y[2, m], 3.0 * y[3, m], 4.0 * y[4, m]
    inverse = 1.0 / max(square * step, 1e-300)
    rate0 = u1 - u0  # integral of u', then of s^k u', and of s^k u over h
    value0 = -(w1 - w0 + c * rate0) * inverse
    rate1 = part * u1 - value0
    value1 = -(part * w1 - rate0 / step + c * rate1) * inverse
    rate2 = part * part * u1 - 2.0 * value1
    value2 = -(part * part * w1 - 2.0 * rate1 / step + c * rate2) * inverse
    rate3 = part * part * part * u1 - 3.0 * value2
    cross = a * rate0 + b * rate1 + d * rate2 + e * rate3
    own = a * a + part * (a * b + part * ((b * b + 2.0 * a * d) / 3.0 + part * (
        0.5 * (a * e + b * d) + part * ((d * d + 2.0 * b * e) / 5.0 + part * (
            d * e / 3.0 + part * e * e / 7.0)))))  # fmt: skip
    return lost + c * (2.0 * cross + own * part) / step
