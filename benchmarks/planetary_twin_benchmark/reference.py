"""A converged reference: SciPy's DOP853 from event to event.

This explicit Runge-Kutta method of order 8 has its own error control and event location (Brent's
method on its own interpolant). It shares the equations of motion with the integrator, but no step,
step control, interpolant or event location.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np
from planetary_twin_core_parts import OPEN, accept, body_speed, contact_event, observe
from scipy.integrate import solve_ivp

from planetary_twin_py._core import AXES, QUANTITIES, Evaluation, begin_step, cycle_shift, forces
from planetary_twin_py.model.clock import delay, instant, run_on
from planetary_twin_py.run.engine import Engine
from planetary_twin_py.scene import Scene

from .samples import samples_until

RELATIVE, ABSOLUTE_X, ABSOLUTE_V = 1e-11, 1e-16, 1e-12
TIGHT = 1e-8  # tolerance of Rosenbrock's method, where the axes move
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


def converged(scene: Scene, duration: float, sample_rate: float) -> np.ndarray:
    """Samples as those of `Reference`; with moving axes, which it has no equations for, of
    Rosenbrock's method at a tight tolerance. It has other steps, but the same event location.
    """
    if not scene.moving_axes:
        return Reference(scene).run(duration, sample_rate)
    engine, room = Engine(scene, TIGHT, "rosenbrock"), round(duration * sample_rate)
    return samples_until(engine, duration, 1, sample_rate, room).mesh


class Reference:
    """Integrates a scene from the same start as `Engine`, and samples its meshes."""

    def __init__(self, scene: Scene) -> None:
        self._engine = Engine(scene, 1e-8)
        self._model, self._integrator = self._engine.model, self._engine.integrator
        self._bodies, self._axes = int(self._engine.train.bodies), int(self._engine.train.axes)
        self._trim = np.zeros(AXES)
        self._work = Evaluation()
        self._x = np.zeros_like(self._integrator.begin.x)
        self._v = np.zeros_like(self._integrator.begin.v)

    def run(self, duration: float, sample_rate: float) -> np.ndarray:
        """Samples (samples, QUANTITIES, meshes) at whole multiples of 1/sample_rate [s]."""
        count = round(duration * sample_rate)
        samples = np.zeros((count, QUANTITIES, int(self._engine.train.meshes)))
        taken = 0
        while taken < count:
            begin_step(self._model, self._integrator)
            stretch = self._stretch()
            while taken < count:
                wait = delay(self._integrator.begin, instant((taken + 1) / sample_rate))
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
        begin, n = self._integrator.begin, self._bodies
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
        slew = self._integrator.constants.slew[: self._axes]
        gap = (self._model.operation.target_speed - self._integrator.begin.set_speed)[: self._axes]
        return min([LONGEST, *(gap[slew != 0.0] / slew[slew != 0.0])])

    def _unpack(self, y: np.ndarray) -> None:
        n = self._bodies
        self._x[:n], self._v[:n], self._trim[: self._axes] = y[:n], y[n : 2 * n], y[2 * n :]

    def _derivative(self, t: float, y: np.ndarray) -> np.ndarray:
        n, train, integrator = self._bodies, self._engine.train, self._integrator
        self._unpack(y)
        begin = integrator.begin
        forces(
            self._model, begin, integrator.constants, self._x, self._v, t, self._trim, self._work
        )
        set_speed = begin.set_speed + integrator.constants.slew * t
        lag = [
            set_speed[a] - body_speed(train, begin, self._v, train.coupling.ends[2 * a, 0])
            for a in range(self._axes)
        ]
        return np.concatenate([y[n : 2 * n], self._work.force[:n] / train.body.mass[:n], lag])

    def _flanks(self, start: np.ndarray) -> list[Event]:
        """An event for every flank.

        A flank that rounding left beyond its event at the start gets an offset, because SciPy
        detects changes of sign only.
        """
        meshes = range(int(self._engine.train.meshes))
        beyond = [max(0.0, -2.0 * self._contact_event(i, 0.0, start)) for i in meshes]
        return [_ending(lambda t, y, i=i: self._contact_event(i, t, y) + beyond[i]) for i in meshes]

    def _edges(self) -> list[Event]:
        """An event for every closed mesh, whose next tooth pair enters or leaves."""
        closed = np.flatnonzero(
            self._integrator.begin.side[: int(self._engine.train.meshes)] != OPEN
        )
        return [_ending(lambda t, y, i=i: self._to_edge(i, t, y)) for i in closed]

    def _contact_event(self, i: int, t: float, y: np.ndarray) -> float:
        advance, pace = self._mesh_cycles(t, y)
        integrator = self._integrator
        position = (advance, pace, 0.0)
        return float(
            contact_event(
                self._model, integrator.begin, integrator.constants, i, self._x, self._v, position
            )
        )

    def _mesh_cycles(self, t: float, y: np.ndarray) -> tuple[float, float]:
        """Mesh cycles since the start of the interval, and their rate [1/s]."""
        self._unpack(y)
        train, rate = self._engine.train, float(self._integrator.constants.cycle_rate)
        shift = cycle_shift(train, self._x) - cycle_shift(train, self._integrator.begin.x)
        return rate * t + shift, rate + cycle_shift(train, self._v)

    def _to_edge(self, i: int, t: float, y: np.ndarray) -> float:
        """Mesh cycles to the next edge."""
        train, begin, moment = (
            self._engine.train,
            self._integrator.begin,
            self._integrator.constants,
        )
        side, segment, kind = int(begin.side[i]), begin.segment[i], train.mesh.kind[i]
        cycle = moment.start[i] + side * self._mesh_cycles(t, y)[0]
        if side * moment.cycle_rate >= 0.0:
            return float(train.teeth.edge[kind, segment + 1] - cycle)
        return float(cycle - train.teeth.edge[kind, segment])

    def _observe(self, solution: Any, delay: float, out: np.ndarray) -> None:
        self._unpack(solution(delay))
        integrator = self._integrator
        observe(
            self._model,
            integrator.begin,
            integrator.constants,
            self._x,
            self._v,
            delay,
            self._work,
            out,
        )

    def _finish(self, stretch: Any) -> None:
        """Pass the end of the interval to the integrator, which changes contacts and segments."""
        begin, end, n = self._integrator.begin, self._integrator.end, self._bodies
        y, length = stretch.y[:, -1], float(stretch.t[-1])
        self._integrator.end = begin
        end.x[:n], end.v[:n], end.trim[: self._axes] = y[:n], y[n : 2 * n], y[2 * n :]
        run_on(begin, end, length)
        self._integrator.control.step = length
        end.set_speed = begin.set_speed + self._integrator.constants.slew * length
        turn = begin.fraction + begin.speed * length / (2.0 * np.pi)
        end.turns, end.fraction = begin.turns + np.floor(turn), turn - np.floor(turn)
        meshes = int(self._engine.train.meshes)
        met = [i for i, times in enumerate(stretch.t_events[:meshes]) if len(times)]
        accept(self._model, self._integrator, met[0] if met else -1)
        self._integrator.control.changed = True
