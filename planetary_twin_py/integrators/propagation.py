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
from .._records import AXES, BODIES, MESHES, REAL, SMALL, WHOLE, Record, layout
from ..dynamics.equations import EVALUATION
from ..dynamics.state import DAMPING, LEDGER
from .contact_modes import CONTACT_MODES, find_modes
from .oscillator import decay_rates, is_free, wave
from .radau import radau

NODES = 3
ABSCISSA = radau(NODES)
LAST = NODES - 1
# Coefficients of the powers of t/h from values at the nodes.
COEFFICIENT = np.linalg.inv(np.vander(ABSCISSA, increasing=True))
DEGREE = NODES + 1  # of the motion of a free mass
LONGEST_MEMORY = 1e3  # c/(w^2 h) of a mode whose motion keeps ten digits
SCANNED = 8  # times at which flanks are looked at

# A step in the making, and what its dense output reads. q is in m sqrt(kg).
PROPAGATION = layout(
    known=CONTACT_MODES,
    modes=WHOLE,  # place in `known`
    step=REAL,  # [s]
    square=(REAL, (BODIES,)),  # w^2 [1/s^2]
    damping=(REAL, (BODIES,)),  # c [1/s]
    rate=(REAL, (BODIES,)),  # see `oscillator.decay_rates`
    slow=(REAL, (BODIES,)),
    fast=(REAL, (BODIES,)),
    spring=(REAL, (BODIES,)),  # w^2 and c, but 0 for what counts as a free mass
    damper=(REAL, (BODIES,)),
    q=(REAL, (BODIES,)),  # at the start
    p=(REAL, (BODIES,)),  # q' at the start
    force=(REAL, (BODIES,)),  # at the start, friction being as it was before
    rest=(REAL, (NODES, BODIES)),  # at the nodes
    particular=(REAL, (DEGREE + 1, BODIES)),  # motion under the polynomial, of powers of t/h
    free=(REAL, (2, BODIES)),  # q and q' of the free motion at the start
    cosine=(REAL, (NODES, BODIES)),  # `wave` at the nodes
    sine=(REAL, (NODES, BODIES)),
    node_q=(REAL, (NODES, BODIES)),
    node_p=(REAL, (NODES, BODIES)),
    node_x=(REAL, (NODES, BODIES)),
    node_v=(REAL, (NODES, BODIES)),
    node_trim=(REAL, (NODES, AXES)),
    node_d=(REAL, (NODES, MESHES)),
    node_rate=(REAL, (NODES, MESHES)),
    before_d=(REAL, (MESHES,)),  # at the last node, one sweep earlier
    before_rate=(REAL, (MESHES,)),
    evaluation=(EVALUATION, (NODES,)),
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
    run.modes = n
    for m in range(lanes):
        damping = known.shaft_damping[n, m] + moment.tau[0] * known.mesh_damping[n, 0, m]
        damping += moment.tau[1] * known.mesh_damping[n, 1, m]
        square = known.square[n, m]
        run.square[m], run.damping[m] = square, damping
        run.rate[m], run.slow[m], run.fast[m] = decay_rates(square, damping)
        run.now_q[m], run.now_p[m] = train.mass[m] * begin.x[m], train.mass[m] * begin.v[m]
    share = known.share[n]
    combine_both(share, run.now_q, run.now_p, train.bodies, run.q, run.p)
    combine(share, march.first.force, train.bodies, run.force)


@kernel
def set_step(run: Record, lanes: int, h: float) -> None:
    """Free motions of all modes at the nodes of a step of h, and the rest as it is at the start."""
    run.step = h
    for m in range(lanes):
        free = is_free(run.square[m], run.damping[m], h)
        run.spring[m] = 0.0 if free else run.square[m]
        run.damper[m] = 0.0 if free else run.damping[m]
    for n in range(NODES):
        t = ABSCISSA[n] * h
        for m in range(lanes):
            first, second = wave(run.damping[m], run.rate[m], run.slow[m], run.fast[m], t)
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
        square, damping = run.square[m], run.damping[m]
        if not is_free(square, damping, h) and damping > LONGEST_MEMORY * square * h:
            return False
    return True


@law
def respond(run: Record, lanes: int) -> None:
    """The motion of all modes under the polynomial through `rest`."""
    h = run.step
    half, sixth, twelfth = 0.5 * h * h, h * h / 6.0, h * h / 12.0
    for m in range(lanes):
        first, second, third = run.rest[0, m], run.rest[1, m], run.rest[2, m]
        a = COEFFICIENT[0, 0] * first + COEFFICIENT[0, 1] * second + COEFFICIENT[0, 2] * third
        b = COEFFICIENT[1, 0] * first + COEFFICIENT[1, 1] * second + COEFFICIENT[1, 2] * third
        c = COEFFICIENT[2, 0] * first + COEFFICIENT[2, 1] * second + COEFFICIENT[2, 2] * third
        spring, loss = run.spring[m], run.damper[m] / h
        free = spring + loss == 0.0
        inverse = 1.0 / (1.0 if free else spring)
        two = c * inverse
        one = (b - 2.0 * loss * two) * inverse
        zero = (a - loss * one - 2.0 / (h * h) * two) * inverse
        q, p = run.q[m], run.p[m]
        run.particular[0, m] = q if free else zero
        run.particular[1, m] = h * p if free else one
        run.particular[2, m] = half * a if free else two
        run.particular[3, m] = sixth * b if free else 0.0
        run.particular[4, m] = twelfth * c if free else 0.0
        run.free[0, m] = 0.0 if free else q - zero
        run.free[1, m] = 0.0 if free else p - one / h


@law
def modal_state(
    run: Record, m: int, t: float, per_step: float, cosine: float, sine: float
) -> tuple[float, float]:
    """q and q' of mode m at t/h, from `wave` at that time and 1/h."""
    a, b, c = run.particular[0, m], run.particular[1, m], run.particular[2, m]
    d, e = run.particular[3, m], run.particular[4, m]
    u, w = run.free[0, m], run.free[1, m]
    value = a + t * (b + t * (c + t * (d + t * e))) + cosine * u + sine * w
    slope = (b + t * (2.0 * c + t * (3.0 * d + t * 4.0 * e))) * per_step
    return value, slope + (cosine - run.damping[m] * sine) * w - run.square[m] * sine * u


@law
def modes_at(run: Record, lanes: int, delay: float) -> None:
    """q and q' of all modes at any time within the step, in `now_q` and `now_p`."""
    t, per_step = delay / run.step, 1.0 / run.step
    for m in range(lanes):
        first, second = wave(run.damping[m], run.rate[m], run.slow[m], run.fast[m], delay)
        run.now_q[m], run.now_p[m] = modal_state(run, m, t, per_step, first, second)


@kernel
def propagate(model: Record, march: Record, delay: float, x: np.ndarray, v: np.ndarray) -> None:
    """x and v at any time within the step."""
    train, run = model.train, march.run
    modes_at(run, train.lanes, delay)
    form = run.known.form[run.modes]
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
    lanes, bodies, per_step = train.lanes, train.bodies, 1.0 / run.step
    respond(run, lanes)
    for i in range(lanes):
        run.before_d[i], run.before_rate[i] = run.node_d[LAST, i], run.node_rate[LAST, i]
    form, motion = run.known.form[run.modes], run.known.motion[run.modes]
    for n in range(NODES):
        t, q, p = ABSCISSA[n], run.node_q[n], run.node_p[n]
        for m in range(lanes):
            q[m], p[m] = modal_state(run, m, t, per_step, run.cosine[n, m], run.sine[n, m])
        combine_both(form, q, p, bodies, run.node_x[n], run.node_v[n])
        combine_both(motion, q, p, bodies, run.node_d[n], run.node_rate[n])
        trim_at(model, march, t * run.step, run.node_x[n], run.node_trim[n])


@kernel
def integrate_powers(march: Record, lanes: int, h: float) -> None:
    """Fill the ledger at h seconds into the step.

    By quadrature at the nodes; what damping takes from modes that swing is known exactly.
    """
    run, end = march.run, march.end
    end.energy[:] = march.begin.energy
    t, lost = h / run.step, 0.0
    for n in range(NODES):
        weight, u = 0.0, run.step
        for k in range(NODES):
            u *= t
            weight += COEFFICIENT[k, n] * u / (k + 1)
        for e in range(LEDGER):
            end.energy[e] += weight * run.evaluation[n].power[e]
        for m in range(lanes):
            damped = weight * run.damping[m] * run.node_p[n, m] ** 2
            lost -= damped if _swings(run, m) else 0.0
    for m in range(lanes):
        first, second = run.cosine[LAST, m], run.sine[LAST, m]
        if h != run.step:
            first, second = wave(run.damping[m], run.rate[m], run.slow[m], run.fast[m], h)
        lost += _damped(run, m, h, first, second) if _swings(run, m) else 0.0
    end.energy[DAMPING] += lost


@law
def _swings(run: Record, m: int) -> bool:
    """Whether a mode has free waves, of which quadrature might miss what is damped."""
    c = run.damper[m]
    return 0.0 < c <= LONGEST_MEMORY * run.spring[m] * run.step


@law
def _damped(run: Record, m: int, h: float, first: float, second: float) -> float:
    """Integral of c q'^2 over h seconds for a mode that swings, with `wave` at its end [J].

    q' is a polynomial b(t) and the rate of a free motion u. By itself that loses c int u'^2, the
    energy (u'^2 + w^2 u^2)/2 it has less at the end; int t^k u' and int t^k u follow from each
    other by u'' + c u' + w^2 u = 0.
    """
    c, square = run.damping[m], run.square[m]
    u0, w0 = run.free[0, m], run.free[1, m]
    u1, w1 = first * u0 + second * w0, (first - c * second) * w0 - square * second * u0
    lost = 0.5 * (w0 * w0 - w1 * w1 + square * (u0 * u0 - u1 * u1))
    b = run.particular[1, m] / run.step  # b(t) = b + a t
    a = 2.0 * run.particular[2, m] / (run.step * run.step)
    moved = u1 - u0  # integral of u'
    swept = -(w1 - w0 + c * moved) / max(square, 1e-300)  # of u
    carried = h * u1 - swept  # of t u'
    own = h * (b * b + h * (a * b + h * a * a / 3.0))
    return lost + c * (2.0 * (b * moved + a * carried) + own)
