"""A converged reference: SciPy's DOP853 from event to event.

This explicit Runge-Kutta method of order 8 has its own error control and event location (Brent's
method on its own interpolant). It shares the equations of motion with the march, but no step, step
control, interpolant or event location.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from planetary_twin_py._core import (
    AXES,
    OPEN,
    QUANTITIES,
    Evaluation,
    accept,
    begin_step,
    body_speed,
    cycle_shift,
    departure,
    forces,
    observe,
)
from planetary_twin_py.engine import Engine
from planetary_twin_py.integrators.clock import delay, instant, run_on
from planetary_twin_py.scene import Scene

RELATIVE, ABSOLUTE_X, ABSOLUTE_V = 1e-11, 1e-16, 1e-12
LONGEST = 1e-3  # [s] between two restarts
LOOKS = 6  # checks per step for flanks that meet and separate within it


Event = Callable[[float, np.ndarray], float]


def _ending(event: Any) -> Event:
    """Mark an event: integration ends where it falls below zero."""
    event.terminal, event.direction = True, -1.0
    return event


def _missed(stretch: Any, flanks: list[Event]) -> float | None:
    """A time within the interval at which a flank is beyond its event, or None."""
    for begin, end in pairwise(stretch.t):
        for t in np.linspace(begin, end, LOOKS + 2)[1:-1]:
            y = stretch.sol(t)
            if any(flank(t, y) < -ABSOLUTE_X for flank in flanks):
                return float(t)
    return None


class Reference:
    """Integrates a scene from the same start as `Engine`, and samples its meshes."""

    def __init__(self, scene: Scene) -> None:
        self._engine = Engine(scene, 1e-8)
        self._model, self._march = self._engine.model, self._engine.march
        self._bodies, self._axes = int(self._engine.train.bodies), int(self._engine.train.axes)
        self._trim = np.zeros(AXES)
        self._work = Evaluation()
        self._x = np.zeros_like(self._march.begin.x)
        self._v = np.zeros_like(self._march.begin.v)

    def run(self, duration: float, sample_rate: float) -> np.ndarray:
        """Samples (samples, QUANTITIES, meshes) at whole multiples of 1/sample_rate [s]."""
        count = round(duration * sample_rate)
        samples = np.zeros((count, QUANTITIES, int(self._engine.train.meshes)))
        taken = 0
        while taken < count:
            begin_step(self._model, self._march)
            stretch = self._stretch()
            while taken < count:
                wait = delay(self._march.begin, instant((taken + 1) / sample_rate))
                if wait > stretch.t[-1]:
                    break
                self._observe(stretch.sol, wait, samples[taken])
                taken += 1
            self._finish(stretch)
        return samples

    def _stretch(self) -> Any:
        """Integrate from `begin` to the next event.

        SciPy checks flanks at the ends of its steps, and misses those that meet and separate within
        a step; such an interval is repeated with an end at that time.
        """
        begin, n = self._march.begin, self._bodies
        start = np.concatenate([begin.x[:n], begin.v[:n], begin.trim[: self._axes]])
        flanks, edges = self._flanks(start), self._edges()
        end: float | None = self._longest()
        while end is not None:
            stretch = self._integrate(start, end, flanks + edges)
            end = _missed(stretch, flanks)
        return stretch

    def _integrate(self, start: np.ndarray, end: float, events: list[Event]) -> Any:
        n = self._bodies
        tolerance = np.repeat([ABSOLUTE_X, ABSOLUTE_V, ABSOLUTE_X], [n, n, self._axes])
        return solve_ivp(
            self._derivative, (0.0, end), start, method="DOP853", rtol=RELATIVE, atol=tolerance,
            events=events, dense_output=True,
        )  # fmt: skip

    def _longest(self) -> float:
        slew = self._march.constants.slew[: self._axes]
        gap = (self._model.load.target_speed - self._march.begin.set_speed)[: self._axes]
        return min([LONGEST, *(gap[slew != 0.0] / slew[slew != 0.0])])

    def _unpack(self, y: np.ndarray) -> None:
        n = self._bodies
        self._x[:n], self._v[:n], self._trim[: self._axes] = y[:n], y[n : 2 * n], y[2 * n :]

    def _derivative(self, t: float, y: np.ndarray) -> np.ndarray:
        n, train, march = self._bodies, self._engine.train, self._march
        self._unpack(y)
        begin = march.begin
        forces(self._model, begin, march.constants, self._x, self._v, t, self._trim, self._work)
        set_speed = begin.set_speed + march.constants.slew * t
        lag = [
            set_speed[a] - body_speed(train, begin, self._v, train.coupling[2 * a, 0])
            for a in range(self._axes)
        ]
        return np.concatenate([y[n : 2 * n], self._work.force[:n] / train.mass[:n], lag])

    def _flanks(self, start: np.ndarray) -> list[Event]:
        """An event for every flank.

        A flank that rounding left beyond its event at the start gets an offset, because SciPy
        detects changes of sign only.
        """
        meshes = range(int(self._engine.train.meshes))
        beyond = [max(0.0, -2.0 * self._departure(i, 0.0, start)) for i in meshes]
        return [_ending(lambda t, y, i=i: self._departure(i, t, y) + beyond[i]) for i in meshes]

    def _edges(self) -> list[Event]:
        """An event for every closed mesh, whose next tooth pair enters or leaves."""
        closed = np.flatnonzero(self._march.begin.side[: int(self._engine.train.meshes)] != OPEN)
        return [_ending(lambda t, y, i=i: self._to_edge(i, t, y)) for i in closed]

    def _departure(self, i: int, t: float, y: np.ndarray) -> float:
        advance, pace = self._mesh_cycles(t, y)
        march = self._march
        stand = (advance, pace, 0.0)
        return float(
            departure(self._model, march.begin, march.constants, i, self._x, self._v, stand)
        )

    def _mesh_cycles(self, t: float, y: np.ndarray) -> tuple[float, float]:
        """Mesh cycles since the start of the interval, and their rate [1/s]."""
        self._unpack(y)
        train, rate = self._engine.train, float(self._march.constants.cycle_rate)
        shift = cycle_shift(train, self._x) - cycle_shift(train, self._march.begin.x)
        return rate * t + shift, rate + cycle_shift(train, self._v)

    def _to_edge(self, i: int, t: float, y: np.ndarray) -> float:
        """Mesh cycles to the next edge."""
        train, begin, moment = self._engine.train, self._march.begin, self._march.constants
        side, segment, kind = int(begin.side[i]), begin.segment[i], train.kind[i]
        cycle = moment.start[i] + side * self._mesh_cycles(t, y)[0]
        if side * moment.cycle_rate >= 0.0:
            return float(train.edge[kind, segment + 1] - cycle)
        return float(cycle - train.edge[kind, segment])

    def _observe(self, solution: Any, delay: float, out: np.ndarray) -> None:
        self._unpack(solution(delay))
        march = self._march
        observe(self._model, march.begin, march.constants, self._x, self._v, delay, self._work, out)

    def _finish(self, stretch: Any) -> None:
        """Pass the end of the interval to the march, which changes contacts and segments."""
        begin, end, n = self._march.begin, self._march.end, self._bodies
        y, length = stretch.y[:, -1], float(stretch.t[-1])
        self._march.end = begin
        end.x[:n], end.v[:n], end.trim[: self._axes] = y[:n], y[n : 2 * n], y[2 * n :]
        run_on(begin, end, length)
        self._march.control.step = length
        end.set_speed = begin.set_speed + self._march.constants.slew * length
        turn = begin.fraction + begin.speed * length / (2.0 * np.pi)
        end.turns, end.fraction = begin.turns + np.floor(turn), turn - np.floor(turn)
        meshes = int(self._engine.train.meshes)
        met = [i for i, times in enumerate(stretch.t_events[:meshes]) if len(times)]
        accept(self._model, self._march, met[0] if met else -1)
        self._march.control.changed = True
