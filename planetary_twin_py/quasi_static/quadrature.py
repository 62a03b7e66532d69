"""Integrals of what a quasi-static run adds up, by Gauss' rule on panels between tooth pair events.

Panels lie between the places in the mesh cycle where a tooth pair begins or ends to enter or
leave, or is at its pitch point. Where friction turns its sense they are halved until the rule on
both halves agrees with that on the whole.
"""

from __future__ import annotations

import math

import numpy as np

from .._compile import allocating, kernel
from .._records import MESHES, Record
from ..dynamics.cycle import frame_cycle
from ..dynamics.moment import frame_cycle_rate
from ..dynamics.state import BEARING, CHURNING, FRICTION, WORK
from ..integrators.clock import Instant, delay
from .equilibrium import settle
from .motion import turn_to
from .totals import NODES, PEAKS, TOTALS, WEIGHTS, Totals, add_rates, see_ends, see_node

PANELS = 1024  # room
NARROWEST = 1e-10  # of a mesh cycle: a panel about a jump of the stiffness
SHARE = 1.0 / 64  # of the mesh cycle; a narrower panel may err as much as one that wide
NOTHING = 1e-12  # of the power of the first motor: less of a loss is none
SHORTEST_PANEL, LONGEST_PANEL = 1e-12, 0.1  # [s]
PER_RIPPLE = 8  # panels at least to a cycle of the torque ripple
ON_EDGE = 1e-11  # mesh cycles within which a panel counts as ended


@kernel
def integrate(
    model: Record,
    tolerance: float,
    origin: Record,
    run: Record,
    span: tuple[float, float],
    shown: np.ndarray,
    out: np.ndarray,
    peak: np.ndarray,
) -> None:
    """Write the totals (TOTALS,) of a span of time since `origin` [s] that is smooth into `out`.

    Raises `peak` (PEAKS, MESHES) to what is seen there.
    """
    half = 0.5 * (span[1] - span[0])
    out[:] = 0.0
    for n in range(NODES.size):
        turn_to(model, origin, span[0] + half * (1.0 + NODES[n]), run.state)
        settle(model, tolerance, run, shown)
        add_rates(model.train, run.evaluation.power, shown, half * WEIGHTS[n], out)
        see_node(model.train, shown, n, peak)
    see_ends(model.train, peak)


@kernel
def _lost(energy: np.ndarray) -> float:
    return energy[FRICTION] + energy[BEARING] + energy[CHURNING]


@allocating
def divide_cycle(
    model: Record,
    tolerance: float,
    origin: Record,
    run: Record,
    edges: np.ndarray,
    period: float,
    shown: np.ndarray,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Panels of one mesh cycle of steady running from `origin` on.

    Args:
        model, tolerance, run, shown: see `settle`.
        origin: where the cycle begins.
        edges: (n,) from 0 to 1, shares of the cycle between which nothing jumps.
        period: of the cycle [s].

    Returns:
        Edges of the panels (m,), the totals up to them (m, TOTALS), and the peaks of the panel
        before each (m, PEAKS, MESHES).

    Raises:
        ValueError: the tolerance asks for too many panels.
    """
    phase, energy, peaks = (
        np.zeros(PANELS),
        np.zeros((PANELS, TOTALS)),
        np.zeros((PANELS, PEAKS, MESHES)),
    )
    whole, left, right = np.zeros(TOTALS), np.zeros(TOTALS), np.zeros(TOTALS)
    coarse, peak = np.zeros((PEAKS, MESHES)), np.zeros((PEAKS, MESHES))
    loss = given = 0.0
    for n in range(edges.size - 1):
        span = (edges[n] * period, edges[n + 1] * period)
        integrate(model, tolerance, origin, run, span, shown, whole, coarse)
        loss += abs(_lost(whole))
        given += abs(whole[WORK])
    loss = max(loss, NOTHING * given)
    count, waiting = 0, np.zeros(PANELS)
    for n in range(edges.size - 1):
        waiting[0], top = edges[n + 1], 0
        while top >= 0:
            low, high = phase[count], waiting[top]
            middle = 0.5 * (low + high)
            begin, centre, end = low * period, middle * period, high * period
            peak[:] = 0.0
            integrate(model, tolerance, origin, run, (begin, end), shown, whole, coarse)
            integrate(model, tolerance, origin, run, (begin, centre), shown, left, peak)
            integrate(model, tolerance, origin, run, (centre, end), shown, right, peak)
            error = abs(_lost(left) + _lost(right) - _lost(whole))
            if error <= tolerance * loss * max(high - low, SHARE) or high - low < NARROWEST:
                if count + 1 == PANELS:
                    raise ValueError("tolerance: too small for the losses of this scene")
                phase[count + 1] = high
                energy[count + 1] = energy[count] + left + right
                peaks[count + 1] = peak
                count += 1
                top -= 1
            else:
                top += 1
                waiting[top] = middle
    return phase[: count + 1], energy[: count + 1], peaks[: count + 1]


@kernel
def _step(model: Record, state: Record, edges: np.ndarray) -> float:
    """Time [s] from `state` to the end of its panel."""
    train, load = model.train, model.load
    step, bend = LONGEST_PANEL, 0.0
    for a in range(train.axes):
        gap = load.target_speed[a] - state.set_speed[a]
        if gap != 0.0:
            step = min(step, abs(gap) / load.slew_rate)
            bend += train.cycles[a] * math.copysign(load.slew_rate, gap) / (2.0 * math.pi)
    if load.ripple > 0.0:
        turn = abs(state.speed[0]) + load.slew_rate * step
        step = min(step, 2.0 * math.pi / (PER_RIPPLE * load.ripple_order * turn))
    rate, cycle = frame_cycle_rate(train, state), frame_cycle(train, state, 1)
    sense = rate if rate != 0.0 else bend
    if sense == 0.0:
        return step
    if rate * bend < 0.0:
        step = min(step, -rate / bend)  # where the motion turns
    sense = math.copysign(1.0, sense)
    distance = 1.0
    for n in range(edges.size):
        ahead = sense * (edges[n] - cycle)
        ahead -= math.floor(ahead)
        if ON_EDGE < ahead < distance:
            distance = ahead
    # distance = |rate| t + sense bend t^2/2
    square = rate * rate + 2.0 * sense * bend * distance
    if square >= 0.0:
        step = min(step, 2.0 * distance / (abs(rate) + math.sqrt(square)))
    return step


@allocating
def march(
    model: Record,
    tolerance: float,
    mark: Record,
    run: Record,
    edges: np.ndarray,
    until: Instant,
    stop: bool,
    totals: Totals,
) -> None:
    """Move `mark`, a STATE, panel by panel, as long as they end by `until`.

    Args:
        model, tolerance, run: see `settle`.
        mark: where the motors are.
        edges: (n,) in mesh cycles of the frame, within [0, 1).
        until: the instant asked for.
        stop: whether to end where all speeds are those wanted.
        totals: which grow along.
    """
    gain, load = np.zeros(TOTALS), model.load
    while True:
        steady = True
        for a in range(model.train.axes):
            steady = steady and mark.set_speed[a] == load.target_speed[a]
        length = max(_step(model, mark, edges), SHORTEST_PANEL)
        if length > delay(mark, until) or (stop and steady):
            return
        integrate(model, tolerance, mark, run, (0.0, length), totals.shown, gain, totals.peak)
        totals.integral[:] += gain
        turn_to(model, mark, length, mark)
