"""One step of exponential collocation.

The rest of `propagation` is taken at Radau's points of the step, answered exactly, and taken anew
at what comes out, until that moves no more. So a step is as long as the *rest* is smooth, however
the meshes swing or stiffly settle (exponential Runge-Kutta methods of collocation type: Hochbruck
and Ostermann 2010, Exponential integrators, Acta Numerica 19, section 2.2).
"""

from __future__ import annotations

import math

from .._compile import kernel
from .._records import Record
from ..dynamics.equations import begin_pairs, drive, rub, squeeze
from ..dynamics.tooth_friction import evaluate
from .propagation import (
    COEFFICIENT,
    LAST,
    NODES,
    modal_state,
    place_bodies,
    respond,
    set_step,
    visit,
)

MOST_SWEEPS = 6
SHARE = 0.3  # of the tolerance that a sweep not made may leave
WEAKEST_PULL = 0.5  # of a sweep, beyond which a shorter step or another method is called for
TAIL = 0.2  # share of the highest power of the polynomial that counts as its error
SETTLING = 40.0  # such a share moves a mode by 1/40 of what it would move it at rest


@kernel
def collocate(model: Record, march: Record, h: float) -> tuple[float, bool]:
    """Try a step of h into x and v of `end`.

    Returns:
        Its error over what is allowed, and whether the sweeps came to rest.
    """
    train, run = model.train, march.run
    set_step(run, train.bodies, h)
    for n in range(NODES):
        run.rest[n] = run.start
        run.evaluation[n].rubbing[:] = march.first.rubbing
    respond(run, train.bodies)
    if run.known.varies[run.modes] == 1:
        _settle_meshes(model, march)
    return _settle_friction(model, march)


@kernel
def _settle_meshes(model: Record, march: Record) -> None:
    """Sweep with friction as it is: where stiffness changes fast, this saves evaluating it."""
    run, change = march.run, math.inf
    pull = run.known.pull[run.modes, 0] * run.step
    for sweep in range(MOST_SWEEPS):
        before = change
        _press_again(model, march)
        change = _move_on(model, march)
        if sweep > 0 and before > 0.0:
            pull = change / before
            run.known.pull[run.modes, 0] = pull / run.step
        if change * pull <= SHARE:
            return


@kernel
def _settle_friction(model: Record, march: Record) -> tuple[float, bool]:
    """Sweep until what the next one would change is a share of the tolerance."""
    run, change, tail = march.run, math.inf, 0.0
    pull = run.known.pull[run.modes, 1] * run.step
    for sweep in range(MOST_SWEEPS):
        before = change
        _sweep(model, march)
        march.control.evaluations += NODES
        change = _move_on(model, march)
        if sweep == 0:
            tail = _tail(model, march)
        elif before > 0.0:
            pull = change / before
            run.known.pull[run.modes, 1] = pull / run.step
        if not tail <= 1.0 or change * pull <= SHARE:
            return (tail if math.isfinite(tail + change) else math.inf), True
        if sweep > 0 and not pull <= WEAKEST_PULL:
            break
    return math.inf, False


@kernel
def _press_again(model: Record, march: Record) -> None:
    """Take the rest anew at all nodes, while friction stays what it is."""
    train, begin, moment, run = model.train, march.begin, march.moment, march.run
    pairs = run.evaluation[0].pairs
    for n in range(NODES):
        node, out = run.node[n], run.evaluation[n]
        visit(model, march, n)
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
        visit(model, march, n)
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
def _move_on(model: Record, march: Record) -> float:
    """Answer the rest as it is now; how far that moves the end of the step, over its tolerance."""
    train, run, end = model.train, march.run, march.end
    respond(run, train.bodies)
    for m in range(train.bodies):
        cosine, sine = run.cosine[LAST, m], run.sine[LAST, m]
        run.now_q[m], run.now_p[m] = modal_state(run, m, 1.0, cosine, sine)
    place_bodies(train, run, end.x, end.v)
    return _difference(model, march)


@kernel
def _difference(model: Record, march: Record) -> float:
    """Largest motion of a mesh between the last sweep and the one before, over its tolerance."""
    train, last, end = model.train, march.run.node[LAST], march.end
    largest = total = 0.0  # NaN would get lost in a maximum
    for i in range(train.meshes):
        d = rate = 0.0
        for a in range(3):
            j = train.body[i, a]
            d += train.sign[i, a] * (end.x[j] - last.x[j])
            rate += train.sign[i, a] * (end.v[j] - last.v[j])
        largest = max(largest, abs(d), march.moment.tau[train.kind[i]] * abs(rate))
        total += d + rate
    return largest / march.control.tolerance_x if math.isfinite(total) else math.inf


@kernel
def _tail(model: Record, march: Record) -> float:
    """Local error, what the highest power of the polynomial moves, over its tolerance."""
    train, run, largest = model.train, march.run, 0.0
    h, n = run.step, run.modes
    for m in range(train.bodies):
        tail = below = 0.0
        for k in range(NODES):
            tail += COEFFICIENT[LAST, k] * run.rest[k, m]
            below += COEFFICIENT[LAST - 1, k] * run.rest[k, m]
        static = 1.0 / max(run.square[m], SETTLING / (h * h))
        ratio = abs(tail) / (abs(tail) + abs(below) + 1e-300)
        if run.slow[m] == 0:  # steps within the memory of the mode, whose errors add up at random
            static *= math.sqrt(1.0 + 2.0 / (run.damping[m] * h + 1e-6))
        run.now_q[m] = abs(tail) * ratio * TAIL * static
    for i in range(train.meshes):
        total = 0.0
        for m in range(train.bodies):
            total += abs(run.known.motion[n, i, m]) * run.now_q[m]
        largest = max(largest, total)
    return largest / march.control.tolerance_x
