"""A step whose meshes move exactly, under a polynomial for all that is not linear.

M x'' = F(t, x, v) reads q'' + c q' + w^2 q = rest in the modes of the meshes in contact. The rest
is friction, machines, errors of form, damping out of proportion, stiffness that changes within
its segment; a polynomial through its values at the nodes of the step is answered exactly, at the
nodes and at any time between them.
"""

from __future__ import annotations

import numpy as np

from .._compile import kernel, law
from .._records import AXES, BODIES, MESHES, REAL, SMALL, WHOLE, Record, layout
from ..dynamics.cycle import cycle_shift
from ..dynamics.equations import EVALUATION
from ..dynamics.state import DAMPING, LEDGER
from ..dynamics.tooth_friction import INSTANTS
from .contact_modes import CONTACT_MODES, find_modes
from .oscillator import SERIES, is_slow, wave
from .radau import radau

NODES = INSTANTS
ABSCISSA = radau(NODES)
LAST = NODES - 1
# Coefficients of the powers of t/h from values at the nodes.
COEFFICIENT = np.linalg.inv(np.vander(ABSCISSA, increasing=True))
LONGEST_MEMORY = 1e3  # c/(w^2 h) of a mode whose motion keeps ten digits
SCANNED = 8  # times at which flanks are looked at

NODE = layout(
    delay=REAL,  # [s]
    advance=REAL,  # mesh cycles since the start
    pace=REAL,  # mesh cycles per second
    x=(REAL, (BODIES,)),
    v=(REAL, (BODIES,)),
    trim=(REAL, (AXES,)),
)

# A step in the making, and what its dense output reads. q is in m sqrt(kg).
PROPAGATION = layout(
    known=CONTACT_MODES,
    modes=WHOLE,  # place in `known`
    step=REAL,  # [s]
    square=(REAL, (BODIES,)),  # w^2 [1/s^2]
    damping=(REAL, (BODIES,)),  # c [1/s]
    slow=(SMALL, (BODIES,)),
    q=(REAL, (BODIES,)),  # at the start
    p=(REAL, (BODIES,)),  # q' at the start
    start=(REAL, (BODIES,)),  # rest at the start, friction being as it was before
    rest=(REAL, (NODES, BODIES)),  # at the nodes
    particular=(REAL, (SERIES, BODIES)),  # motion under the polynomial, of powers of t/h
    free=(REAL, (2, BODIES)),  # q and q' of the free motion at the start
    cosine=(REAL, (NODES, BODIES)),  # `wave` at the nodes
    sine=(REAL, (NODES, BODIES)),
    node=(NODE, (NODES,)),
    node_q=(REAL, (NODES, BODIES)),
    node_p=(REAL, (NODES, BODIES)),
    evaluation=(EVALUATION, (NODES,)),  # the tooth pairs of all are in the first
    power=(REAL, (NODES, LEDGER)),
    now_q=(REAL, (BODIES,)),  # room to work in
    now_p=(REAL, (BODIES,)),
    wave_q=(REAL, (NODES, BODIES)),  # free motion at the nodes
    wave_p=(REAL, (NODES, BODIES)),
    suspect=(SMALL, (MESHES,)),  # may change its contact within the step
    scan_q=(REAL, (SCANNED, BODIES)),  # at even times
    scan_p=(REAL, (SCANNED, BODIES)),
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
def set_step(run: Record, bodies: int, h: float) -> None:
    """Free motions of all modes at the nodes of a step of h."""
    run.step = h
    for m in range(bodies):
        run.slow[m] = 1 if is_slow(run.square[m], run.damping[m], h) else 0
        if run.slow[m] == 0:
            for n in range(NODES):
                cosine, sine = wave(run.square[m], run.damping[m], ABSCISSA[n] * h)
                run.cosine[n, m], run.sine[n, m] = cosine, sine


@kernel
def resolves(run: Record, bodies: int, h: float) -> bool:
    """Whether a step of h keeps its digits.

    A mode that creeps for much longer than the step is a small difference of a polynomial and a
    wave, both larger by the square of that ratio.
    """
    for m in range(bodies):
        square, damping = run.square[m], run.damping[m]
        if not is_slow(square, damping, h) and damping > LONGEST_MEMORY * square * h:
            return False
    return True


@kernel
def respond(run: Record, bodies: int) -> None:
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
def modal_state(run: Record, m: int, t: float, cosine: float, sine: float) -> tuple[float, float]:
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
def place_bodies(train: Record, run: Record, x: np.ndarray, v: np.ndarray) -> None:
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
        run.now_q[m], run.now_p[m] = modal_state(run, m, delay / run.step, cosine, sine)
    place_bodies(train, run, x, v)


@kernel
def trim_at(model: Record, march: Record, delay: float, x: np.ndarray, trim: np.ndarray) -> None:
    """Trim of the speed loops, the integral of set-point minus speed."""
    train, begin, moment = model.train, march.begin, march.moment
    for a in range(train.axes):
        motor = train.coupling[2 * a, 0]
        lag = begin.set_speed[a] - begin.speed[a] + 0.5 * moment.slew[a] * delay
        trim[a] = begin.trim[a] + lag * delay - (x[motor] - begin.x[motor]) / train.radius[motor]


@kernel
def visit(model: Record, march: Record, n: int) -> None:
    """Where the motion stands at node n."""
    train, moment, run = model.train, march.moment, march.run
    node = run.node[n]
    node.delay = ABSCISSA[n] * run.step
    for m in range(train.bodies):
        cosine, sine = run.cosine[n, m], run.sine[n, m]
        run.now_q[m], run.now_p[m] = modal_state(run, m, ABSCISSA[n], cosine, sine)
        run.node_q[n, m], run.node_p[n, m] = run.now_q[m], run.now_p[m]
    place_bodies(train, run, node.x, node.v)
    trim_at(model, march, node.delay, node.x, node.trim)
    shift = cycle_shift(train, node.x) - cycle_shift(train, march.begin.x)
    node.advance = moment.cycle_rate * node.delay + shift
    node.pace = moment.cycle_rate + cycle_shift(train, node.v)


@kernel
def integrate_powers(march: Record, bodies: int, h: float) -> None:
    """Fill the ledger at h seconds into the step.

    By quadrature at the nodes; what damping takes from modes that swing is known exactly.
    """
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
        for m in range(bodies):
            if _swings(run, m):
                damped = run.damping[m] * run.node_p[n, m] ** 2
                end.energy[DAMPING] -= run.step * weight * damped
    for m in range(bodies):
        if _swings(run, m):
            end.energy[DAMPING] += _damped(run, m, h)


@law
def _swings(run: Record, m: int) -> bool:
    """Whether a mode has free waves, of which quadrature might miss what is damped."""
    c = run.damping[m]
    return run.slow[m] == 0 and 0.0 < c <= LONGEST_MEMORY * run.square[m] * run.step


@kernel
def _damped(run: Record, m: int, h: float) -> float:
    """Integral of c q'^2 over h seconds for a fast mode [J].

    q' is a polynomial b(t) and the rate of a free motion u. By itself that loses c int u'^2, the
    energy (u'^2 + w^2 u^2)/2 it has less at the end; int t^k u' and int t^k u follow from each
    other by u'' + c u' + w^2 u = 0.
    """
    c, square = run.damping[m], run.square[m]
    u0, w0 = run.free[0, m], run.free[1, m]
    cosine, sine = wave(square, c, h)
    u1, w1 = cosine * u0 + sine * w0, (cosine - c * sine) * w0 - square * sine * u0
    total = 0.5 * (w0 * w0 - w1 * w1 + square * (u0 * u0 - u1 * u1))
    rate_below = value_below = 0.0  # integrals of t^(k-1) u' and t^(k-1) u
    power = 1.0
    for k in range(NODES - 1):
        start = 1.0 if k == 0 else 0.0
        rate = power * u1 - start * u0 - k * value_below
        value = -(power * w1 - start * w0 - k * rate_below + c * rate) / square
        b = (k + 1) * run.particular[k + 1, m] / run.step ** (k + 1)
        total += 2.0 * c * b * rate
        for n in range(NODES - 1):
            other = (n + 1) * run.particular[n + 1, m] / run.step ** (n + 1)
            total += c * b * other * h ** (k + n + 1) / (k + n + 1)
        rate_below, value_below, power = rate, value, power * h
    return total
