"""Flanks that meet or part within a step, and when."""

from __future__ import annotations

import math

from .._compile import kernel, law
from .._records import Record
from ..dynamics.contact_events import departure, play_left
from ..dynamics.cycle import cycle_shift
from ..dynamics.state import OPEN
from .interpolant import interpolate
from .oscillator import SERIES, wave
from .propagation import NODES, SCANNED, modal_state

SLACK = 0.01  # share of the local tolerance by which flanks may pull or pass each other
ROUNDS = 60  # of closing in on an event


@kernel
def departure_at(model: Record, march: Record, i: int, delay: float) -> float:
    """`departure` of mesh i on the interpolant."""
    if march.control.collocated and model.train.lines[model.train.kind[i]] == 0:
        return _play_at(model, march, i, delay, SLACK * march.control.tolerance_x)
    interpolate(model, march, delay)
    train, moment, x, v = model.train, march.moment, march.dense_x, march.dense_v
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
    """Mesh whose contact changes first within the step, and when; (-1, step) if none does."""
    first, when = -1, march.control.step
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
        run.suspect[i] = 1 if least < waves else 0
        found |= least < waves
    return found


@kernel
def _scan(model: Record, march: Record, end: float) -> None:
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
def _first_scanned(model: Record, march: Record, i: int, end: float) -> int:
    """Number of the first of the scanned times at which mesh i has changed, or SCANNED."""
    train, run = model.train, march.run
    tau, slack = march.moment.tau[train.kind[i]], SLACK * march.control.tolerance_x
    for k in range(SCANNED):
        if train.lines[train.kind[i]] > 0:
            play = departure_at(model, march, i, (k + 1) * end / SCANNED)
        else:
            d = rate = 0.0
            for m in range(train.bodies):
                motion = run.known.motion[run.modes, i, m]
                d += motion * run.scan_q[k, m]
                rate += motion * run.scan_p[k, m]
            play = play_left(model.load, march.begin.side[i], d, tau * rate, slack)
        if play < 0.0:
            return k
    return SCANNED


@kernel
def _play_at(model: Record, march: Record, i: int, delay: float, slack: float) -> float:
    """`departure` of mesh i within the step, where no error of form moves its flanks."""
    train, run, moment = model.train, march.run, march.moment
    d = rate = 0.0
    for m in range(train.bodies):
        motion = run.known.motion[run.modes, i, m]
        cosine = sine = 0.0
        if run.slow[m] == 0:
            cosine, sine = wave(run.square[m], run.damping[m], delay)
        q, p = modal_state(run, m, delay / run.step, cosine, sine)
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
