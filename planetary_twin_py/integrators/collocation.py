"""One step of exponential collocation.

The rest of `propagation` is taken at Radau's points of the step, answered exactly, and taken anew
at what comes out, until that moves no more. So a step is as long as the *rest* is smooth, however
the meshes swing or stiffly settle (exponential Runge-Kutta methods of collocation type: Hochbruck
and Ostermann 2010, Exponential integrators, Acta Numerica 19, section 2.2).
"""

from __future__ import annotations

import math

from .._combine import combine
from .._compile import kernel
from .._overwrite import copy_array
from .._records import Record
from ..dynamics.equations import drive, rub, squeeze
from .memory import recall
from .propagation import power, set_step, visit_nodes

MOST_SWEEPS = 6
SHARE = 0.3  # of the tolerance that a sweep not made may leave
WEAKEST_PULL = 0.5  # of a sweep, beyond which a shorter step or another method is called for
TAIL = 4.0  # by which the estimated error of the polynomial counts more


@kernel
def collocate(model: Record, march: Record, h: float, fresh: bool) -> tuple[float, bool]:
    """Try a step of h, up to the motion at its nodes; `fresh`: the contacts have just changed.

    Returns:
        Its error over what is allowed, and whether the sweeps came to rest.
    """
    train, run = model.train, march.run
    set_step(run, train.lanes, h)
    for n in range(run.nodes.count):
        copy_array(run.evaluation[n].rubbing, march.first.rubbing)
    if fresh:
        recall(train, march)
    visit_nodes(model, march)
    if run.known.varies[run.motion.modes] == 1:
        _settle_meshes(model, march)
        tail = _tail(model, march)
        if not tail <= 1.0:
            return (tail if math.isfinite(tail) else math.inf), True
    return _settle_friction(model, march)


@kernel
def _settle_meshes(model: Record, march: Record) -> None:
    """Sweep with friction as it is: where stiffness changes fast, this saves evaluating it."""
    run, change = march.run, math.inf
    pull = run.known.pull[run.motion.modes, 0] * run.motion.step
    for sweep in range(MOST_SWEEPS):
        before = change
        _sweep(model, march, False)
        visit_nodes(model, march)
        change = _difference(model, march)
        if sweep > 0 and before > 0.0:
            pull = change / before
            run.known.pull[run.motion.modes, 0] = pull / run.motion.step
        if change * pull <= SHARE:
            return


@kernel
def _settle_friction(model: Record, march: Record) -> tuple[float, bool]:
    """Sweep until what the next one would change is a share of the tolerance."""
    run, change, tail = march.run, math.inf, 0.0
    pull = run.known.pull[run.motion.modes, 1] * run.motion.step
    for sweep in range(MOST_SWEEPS):
        before = change
        _sweep(model, march, True)
        march.control.evaluations += run.nodes.count
        visit_nodes(model, march)
        change = _difference(model, march)
        if sweep == 0:
            tail = _tail(model, march)
        elif before > 0.0:
            pull = change / before
            run.known.pull[run.motion.modes, 1] = pull / run.motion.step
        if not tail <= 1.0 or change * pull <= SHARE:
            return (tail if math.isfinite(tail + change) else math.inf), True
        if sweep > 0 and not pull <= WEAKEST_PULL:
            break
    return math.inf, False


@kernel
def _sweep(model: Record, march: Record, rubbing: bool) -> None:
    """Take the rest anew at all nodes, with friction as it was unless `rubbing`."""
    train, begin, moment, run = model.train, march.begin, march.moment, march.run
    share, lanes = run.known.share[run.motion.modes], train.lanes
    for n in range(run.nodes.count):
        out, x, v = run.evaluation[n], run.node_x[n], run.node_v[n]
        delay = run.nodes.abscissa[n] * run.motion.step
        for i in range(lanes):
            out.now.d[i], out.now.rate[i] = run.node_d[n, i], run.node_rate[n, i]
        squeeze(model, begin, moment, x, v, delay, out)
        if rubbing:
            rub(model, begin, moment, v, out)
        drive(model, begin, moment, x, v, delay, run.node_trim[n], out)
        combine(share, out.force, train.bodies, run.rest[n])
        for m in range(lanes):
            own = run.damper[m] * run.node_p[n, m] + run.spring[m] * run.node_q[n, m]
            run.rest[n, m] += own


@kernel
def _difference(model: Record, march: Record) -> float:
    """Largest motion of a mesh, or change of the speed of a body, between the last sweep and the
    one before, over its tolerance."""
    train, run, tau = model.train, march.run, march.moment.tau
    largest = total = 0.0  # NaN would get lost in a maximum
    last = run.nodes.count - 1
    for i in range(train.meshes):
        d = run.node_d[last, i] - run.before_d[i]
        rate = run.node_rate[last, i] - run.before_rate[i]
        largest = max(largest, abs(d), tau[train.kind[i]] * abs(rate))
        total += d + rate
    largest /= march.control.tolerance_x
    for j in range(train.bodies):
        change = abs(run.node_v[last, j] - run.before_v[j])
        largest = max(largest, change / march.control.tolerance_v)
    return largest if math.isfinite(total) else math.inf


@kernel
def _tail(model: Record, march: Record) -> float:
    """Local error, what the highest power of the polynomial moves, over its tolerance."""
    train, run, largest = model.train, march.run, 0.0
    h, lanes = run.motion.step, train.lanes
    highest = run.nodes.count - 1
    share = TAIL * run.nodes.smallest
    settling = 2.0 * (highest + 2) * (highest + 3)  # it moves a mode by such a part of that at rest
    for m in range(lanes):
        tail, below = abs(power(run, highest, m)), abs(power(run, highest - 1, m))
        static = 1.0 / max(run.motion.square[m], settling / (h * h))
        # Steps within the memory of a mode make errors that add up at random.
        lasting = math.sqrt(1.0 + 2.0 / (run.damper[m] * h + 1e-6))
        lasting = 1.0 if run.spring[m] == 0.0 else lasting
        missed = tail * tail / (tail + below + 1e-300) * share * lasting
        brief = 1.0 / max(1.0 / math.sqrt(static), run.damper[m])
        run.now_q[m], run.now_p[m] = missed * static, missed * brief
    combine(run.known.reach[run.motion.modes], run.now_q, train.bodies, run.now_d)
    for i in range(train.meshes):
        largest = max(largest, run.now_d[i])
    error = largest / march.control.tolerance_x
    return max(error, _tail_of_speeds(train, march)) if march.control.slow else error


@kernel
def _tail_of_speeds(train: Record, march: Record) -> float:
    """The same for the speeds of the bodies, from that of the modes in `now_p`."""
    run, largest = march.run, 0.0
    form = run.known.form[run.motion.modes]
    for j in range(train.bodies):
        speed = 0.0
        for m in range(train.bodies):
            speed += abs(form[m, j]) * run.now_p[m]
        largest = max(largest, speed)
    return largest / march.control.tolerance_v
