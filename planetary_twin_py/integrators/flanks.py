"""Flanks that meet or part within a step, and when."""

from __future__ import annotations

import math

from .._combine import combine_both
from .._compile import kernel, law
from .._records import Record
from ..dynamics.contact_events import departure, play_left, widening
from ..dynamics.cycle import cycle_shift
from ..dynamics.form_errors import form_error
from ..dynamics.state import OPEN
from .interpolant import interpolate
from .progress import NO_MESH
from .propagation import SCANNED, modes_at

SLACK = 0.01  # share of the local tolerance by which flanks may pull or pass each other
ROUNDS = 60  # of closing in on an event
TAME = 0.5  # (w h)^2 + c h below which a mode does not turn round between two nodes


@kernel
def departure_at(model: Record, march: Record, i: int, delay: float) -> float:
    """`departure` of mesh i on the interpolant."""
    if march.control.collocated and model.train.lines[model.train.kind[i]] == 0:
        return _play_at(model, march, i, delay, SLACK * march.control.tolerance_x)
    interpolate(model, march, delay)
    train, moment, x, v = model.train, march.moment, march.dense.x, march.dense.v
    advance = moment.cycle_rate * delay + cycle_shift(train, x) - cycle_shift(train, march.begin.x)
    pace = moment.cycle_rate + cycle_shift(train, v)
    slack = SLACK * march.control.tolerance_x
    return departure(model, march.begin, moment, i, x, v, (advance, pace, slack))


@kernel
def at_event(model: Record, march: Record, i: int) -> bool:
    """Whether the step ends where the contact of mesh i changes, to within its slack."""
    play = departure_at(model, march, i, march.control.step)
    return abs(play) <= SLACK * march.control.tolerance_x


@kernel
def first_flank_event(model: Record, march: Record) -> tuple[int, float]:
    """Mesh whose contact changes first within the step, and when; (NO_MESH, step) if none does."""
    first, when = NO_MESH, march.control.step
    if not march.control.collocated:
        for i in range(model.train.meshes):
            if departure_at(model, march, i, when) < 0.0:
                first, when = i, _close_in(model, march, i, 0.0, when)
    elif _suspect_flanks(model, march):
        _scan(model, march, when)
        end = when
        for i in range(model.train.meshes):
            if march.run.suspect[i] == 1:
                place = _first_scanned(model, march, i, end)
                low, high = place * end / SCANNED, (place + 1) * end / SCANNED
                high = min(high, when)
                if low < high and departure_at(model, march, i, high) < 0.0:
                    first, when = i, _close_in(model, march, i, low, high)
    return first, when


@kernel
def _close_in(model: Record, march: Record, i: int, low: float, high: float) -> float:
    """Where the play of mesh i falls below zero: regula falsi, Illinois form (Dahlquist and
    Björck 1974, Numerical Methods, section 6.3)."""
    above, below = departure_at(model, march, i, low), departure_at(model, march, i, high)
    enough, last = 0.1 * SLACK * march.control.tolerance_x, 0
    for _ in range(ROUNDS):
        if -below <= enough or high - low <= 1e-16 * high:
            break
        share = above / (above - below) if above > 0.0 else 0.5
        middle = low + min(max(share, 1e-3), 1.0 - 1e-3) * (high - low)
        value = departure_at(model, march, i, middle)
        if value >= 0.0:
            low, above = middle, value
            if last > 0:
                below *= 0.5
            last = 1
        else:
            high, below = middle, value
            if last < 0:
                above *= 0.5
            last = -1
    return high


@kernel
def _suspect_flanks(model: Record, march: Record) -> bool:
    """Mark the meshes that may change their contact within the step; whether there are any.

    What a mesh has left before it changes is a polynomial, known at the nodes, and free waves,
    which are bounded by their amplitudes.
    """
    train, moment, run = model.train, march.moment, march.run
    lanes, modes, found = train.lanes, run.motion.modes, False
    sun, ring = model.load.release * moment.tau[0], model.load.release * moment.tau[1]
    reach, motion = run.known.reach[modes], run.known.motion[modes]
    for m in range(lanes):
        run.now_q[m], run.now_p[m] = _amplitude(run, m, sun), _amplitude(run, m, ring)
    combine_both(reach, run.now_q, run.now_p, train.bodies, run.now_d, run.now_rate)
    for i in range(train.meshes):
        run.least[i] = -(run.now_d[i] if train.kind[i] == 0 else run.now_rate[i])
    for n in range(run.nodes.count):
        for m in range(lanes):
            u, w = run.motion.free[0, m], run.motion.free[1, m]
            c, s = run.cosine[n, m], run.sine[n, m]
            waves = _has_waves(run, m)
            rate = (c - run.motion.damping[m] * s) * w - run.motion.square[m] * s * u
            run.now_q[m], run.now_p[m] = (c * u + s * w if waves else 0.0), (rate if waves else 0.0)
        combine_both(motion, run.now_q, run.now_p, train.bodies, run.now_d, run.now_rate)
        if n == 0:
            for i in range(train.meshes):
                run.scan_d[0, i] = math.inf
        for i in range(train.meshes):
            tau = sun if train.kind[i] == 0 else ring
            run.scan_d[0, i] = min(run.scan_d[0, i], _left_without_waves(model, march, i, n, tau))
    for i in range(train.meshes):
        suspect = run.scan_d[0, i] + run.least[i] < 0.0
        run.suspect[i] = 1 if suspect else 0
        found |= suspect
    return found


@law
def _left_without_waves(model: Record, march: Record, i: int, n: int, tau: float) -> float:
    """Play that mesh i has left at node n, less what its free waves take or add."""
    train, run, side = model.train, march.run, march.begin.side[i]
    d, rate = run.node_d[n, i], run.node_rate[n, i]
    gap = slower = 0.0
    if train.lines[train.kind[i]] > 0:
        now, angle = run.evaluation[n].now, march.moment.line_angle
        e, e_rate = form_error(train, i, float(side), angle, now.advance, now.pace)
        d, rate = d - e, rate - e_rate
        gap, slower = widening(train, march.moment, i, side, now.advance, now.pace)
    wave = run.now_d[i] + tau * run.now_rate[i]
    left = play_left(model.load, side, (d, tau * rate), (gap, tau * slower), 0.0)
    return left - (side * wave if side != OPEN else abs(wave))


@law
def _has_waves(run: Record, m: int) -> bool:
    """Whether mode m may turn round between two nodes."""
    return (
        run.motion.square[m] * run.motion.step * run.motion.step
        + run.motion.damping[m] * run.motion.step
        > TAME
    )


@law
def _amplitude(run: Record, m: int, tau: float) -> float:
    """Bound on the free motion of mode m and tau times its rate, together."""
    half = 0.5 * run.motion.damping[m]
    swings = run.motion.slow[m] == run.motion.fast[m]
    # From (1, 0): C - tau w^2 S; from (0, 1): S + tau (C - c S); S never exceeds 1/w, nor C 1.
    longest = 1.0 / math.sqrt(max(run.motion.square[m], 1e-300))
    inverse = 1.0 / max(run.motion.rate[m], 1e-300)
    longest = min(longest, inverse) if swings else longest
    lean = half - tau * run.motion.square[m]
    first = 1.0 + abs(lean) * longest
    ratio = lean * inverse
    first = min(first, math.sqrt(1.0 + ratio * ratio)) if swings else first
    bound = first * abs(run.motion.free[0, m]) + (longest + tau) * abs(run.motion.free[1, m])
    return bound if _has_waves(run, m) else 0.0


@kernel
def _scan(model: Record, march: Record, end: float) -> None:
    """Transmission errors at even times up to `end` [s]."""
    train, run = model.train, march.run
    motion = run.known.motion[run.motion.modes]
    for k in range(SCANNED):
        modes_at(run, train.lanes, (k + 1) * end / SCANNED)
        combine_both(motion, run.now_q, run.now_p, train.bodies, run.scan_d[k], run.scan_rate[k])


@kernel
def _first_scanned(model: Record, march: Record, i: int, end: float) -> int:
    """Number of the first of the scanned times at which mesh i has changed, or SCANNED."""
    train, run = model.train, march.run
    tau, slack = march.moment.tau[train.kind[i]], SLACK * march.control.tolerance_x
    for k in range(SCANNED):
        if train.lines[train.kind[i]] > 0:
            play = departure_at(model, march, i, (k + 1) * end / SCANNED)
        else:
            d, rate = run.scan_d[k, i], run.scan_rate[k, i]
            play = play_left(model.load, march.begin.side[i], (d, tau * rate), (0.0, 0.0), slack)
        if play < 0.0:
            return k
    return SCANNED


@kernel
def _play_at(model: Record, march: Record, i: int, delay: float, slack: float) -> float:
    """`departure` of mesh i within the step, where no error of form moves its flanks."""
    train, run, moment = model.train, march.run, march.moment
    modes_at(run, train.lanes, delay)
    d = rate = 0.0
    for m in range(train.bodies):
        motion = run.known.motion[run.motion.modes, m, i]
        d += motion * run.now_q[m]
        rate += motion * run.now_p[m]
    tau = moment.tau[train.kind[i]]
    return play_left(model.load, march.begin.side[i], (d, tau * rate), (0.0, 0.0), slack)
