"""A run in progress: the model of a scene, its state, and the marching integrator.

What `Twin` steps and `simulate` runs through. It knows bodies and meshes by their place in
arrays only; names and messages are for those above it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction

import numpy as np

from ._core import (
    IMPULSE,
    METHODS,
    Control,
    Load,
    March,
    Model,
    Train,
    advance,
    begin_step,
    count_until,
    cut,
    radau,
    stored,
)
from .dynamics.cycle import common_cycles, turns_per_cycle
from .dynamics.mesh_sums import MeshSums, clear, mesh_sums
from .dynamics.oil import build_oil
from .dynamics.speed_loop import SpeedLoopCheck, bandwidth
from .dynamics.start import LoadBuilder, start_state
from .dynamics.static_load import mesh_force, static_torques
from .dynamics.train import build_train, lightest_body
from .integrators.clock import NEVER, Sampling, delay, instant, sampling
from .integrators.interpolant import Samples, new_samples
from .runaway import Limits, RunawayError
from .scene import OperatingPoint, Scene
from .tolerance import check_tolerance

# Tolerances down to which so many points of a step are worth their cost, see docs.
POINTS = ((3e-3, 3), (3e-4, 4), (0.0, 5))
LONGEST_STEP = 1e-3  # [s]
FIRST_STEP = 1e-6  # [s]
SETTLING = 1.0  # of the period of the speed loop, for which steady running must last to count
WATCHED = Fraction(1, 10)  # [s] from one check of a run against its limits to the next
LIGHTEST_MESH_LOAD = 1.0  # [N] smaller mesh forces do not tighten the tolerance further


class _Scale:
    """What tolerances are relative to."""

    def __init__(self, scene: Scene, train: Train) -> None:
        self._per_torque = abs(mesh_force(scene, 1.0))
        self._stiffness = float(train.stiffness.min())
        self._shares = np.abs(static_torques(scene)[::2])
        motors = train.coupling[: 2 * len(self._shares) : 2, 0]
        self._own = train.mass[motors] * train.radius[motors] ** 2
        self.quickness = math.sqrt(2.0 * self._stiffness / lightest_body(train))

    def deflection(self, point: OperatingPoint) -> float:
        """Deflection of the meshes under the torques of steady running [m]."""
        strongest = abs(point.input_torque) + point.torque_ripple
        force = max(self._per_torque * strongest, LIGHTEST_MESH_LOAD)
        return force / self._stiffness + 0.5 * point.backlash

    def yielding(self, load: Load) -> np.ndarray:
        """Deflection of the meshes under each input's acceleration [m s^2/rad].

        A motor turns its own inertia without the meshes.
        """
        inertia = load.inertia.diagonal()[: len(self._own)]
        torque: np.ndarray = (inertia - self._own) / self._shares
        return self._per_torque * torque / self._stiffness


class Engine:
    """Integrates a scene from its start.

    Args:
        scene: what to simulate.
        tolerance: local error of a step, relative to the static deflection of the meshes.
        method: one of METHODS; "march" makes steps by collocation wherever that is fit, else by
            Rosenbrock's method; "auto" makes none where steady running repeats itself. Where gears
            creep, every method makes its steps by Rosenbrock's.

    Raises:
        ValueError: the tolerance is out of range, or the scene cannot be built.
    """

    def __init__(self, scene: Scene, tolerance: float, method: str = "auto") -> None:
        check_tolerance(tolerance)
        self.scene = scene
        self.tolerance = tolerance
        self._may_repeat = method == "auto"
        self.train = build_train(scene)
        self.model = Model(train=self.train)
        self.march = March()
        # Parts of the march that every window looks at: finding them takes longer than the look.
        self._end, self._aside = self.march.end, self.march.aside
        self._repetition, self._last = self.march.repetition, self.march.last
        standing = (self.march.begin, self.march.end, self.march.repetition.start)
        self._ledgers = tuple(state.energy for state in standing)
        self._shown: tuple[float | Fraction, Samples] | None = None
        self._limits = Limits(scene, self.train)
        self._failure: RunawayError | None = None
        control = self.march.control
        control.step = control.next_step = control.next_stiff = FIRST_STEP
        control.longest = LONGEST_STEP
        control.method = METHODS[method]
        self._speed_loop = SpeedLoopCheck(scene, self.train)
        for speed in (scene.drive.speed_control.start_speed, scene.operating_point.input_speed):
            if speed is not None:
                where = scene.operating_point.model_copy(update={"input_speed": speed})
                self._speed_loop.check(where)
        self._loads, self._scale = LoadBuilder(scene, self.train), _Scale(scene, self.train)
        self._oil_at: tuple[float, float] | None = None
        self._cycles: dict[bool, int] = {}
        self._pause = SETTLING / bandwidth(scene)
        self._load(scene.operating_point)
        self.march.begin = self.march.end = start_state(scene, self.model)
        self._prepare()

    def _prepare(self) -> None:
        """Go through all that a window calls; at time zero it changes nothing."""
        begin_step(self.model, self.march)
        self.march.end = self.march.begin  # tooth pairs may have begun to hold
        self.advance(0.0, 1, 1.0, 0)
        self.stored()
        self.take_mesh_sums(0.0)
        cut(self.model, self.march, instant(0.0))

    def _load(self, point: OperatingPoint) -> None:
        """Put an operating point into the model, and scale the tolerances to its deflections."""
        oil_at = point.oil_temperature, point.lambda_ratio
        if self._oil_at != oil_at:
            self.model.oil, self._oil_at = build_oil(self.scene, point), oil_at
        self.model.load = self._loads.build(point)
        control, scale = self.march.control, self._scale
        control.tolerance = self.tolerance
        control.deflection = scale.deflection(point)
        control.yielding = scale.yielding(self.model.load)
        control.quickness = scale.quickness
        points = next(n for least, n in POINTS if self.tolerance > least)
        if self.march.run.nodes.count != points:
            self.march.run.nodes = radau(points)
        control.changed = True
        self._allow_repetition()

    def _allow_repetition(self) -> None:
        """Say in how many mesh cycles all is as before."""
        repetition = self.march.repetition
        rippled = self.model.load.ripple != 0.0
        if rippled not in self._cycles:
            cycles = common_cycles(self.train, self.model.load) if self._may_repeat else 0
            self._cycles[rippled] = cycles
        cycles = self._cycles[rippled]
        if cycles > 0:
            turns = abs(cycles * turns_per_cycle(self.train))
            repetition.numerator, repetition.denominator = turns.numerator, turns.denominator
        repetition.cycles = cycles
        repetition.pause = self._pause

    def advance(
        self, until: float | Fraction, first_sample: int, sample_rate: float, room: int
    ) -> Samples:
        """Integrate to `until` [s]; samples lie at whole multiples of 1/sample_rate.

        Returns `room` samples from number `first_sample` on. A time given as a fraction is exact
        however late it is.

        Raises:
            RunawayError: no step leads on, or to what no gearbox can show, see `runaway`.
        """
        samples, done = new_samples(self.train, room + 1), 0
        for stop in self._stops(until):
            # All that are due by then, and one at the stop, which the next of them overwrites.
            part = room
            if stop != until:
                due = math.floor(Fraction(stop) * Fraction(sample_rate)) + 1 - first_sample
                part = min(max(due, done), room)
            at = sampling(first_sample + done, sample_rate)
            self._run(stop, at, _rows(samples, done, part + 1))
            done = part
        return _rows(samples, 0, room)

    def _stops(self, until: float | Fraction) -> Iterator[float | Fraction]:
        """Instants [s] up to `until` at which the run is checked against its limits."""
        if delay(self._end, instant(until)) > WATCHED:
            stop = self.reached + WATCHED
            while stop < until:
                yield stop
                stop += WATCHED
        yield until

    def _run(self, until: float | Fraction, at: Sampling, samples: Samples) -> None:
        """Fill all `samples` but the last, which is at `until`."""
        if self._failure is not None:
            raise self._failure
        try:
            advance(self.model, self.march, instant(until), NEVER, at, samples)
            self._check(samples)
        except ArithmeticError as reason:
            self._failure = RunawayError(f"the run stops near {float(self.reached):g} s: {reason}")
            raise self._failure from None
        self._shown = until, _rows(samples, len(samples.turns) - 1, None)

    def _check(self, samples: Samples) -> None:
        """Raise an `ArithmeticError` where the train shows what no gearbox can."""
        limits = self._limits
        limits.check_squeeze(samples, self.model.load)
        limits.speed.check(samples.speed)
        limits.torque.check(self.powers[None, IMPULSE : IMPULSE + int(self.train.machines)])

    def sample(self, time: float | Fraction) -> Samples:
        """One sample at `time` [s], the end of the last window."""
        if self._shown is not None and self._shown[0] == time:
            return self._shown[1]
        samples = new_samples(self.train, 1)
        self._run(time, sampling(1, 1.0), samples)
        return samples

    def change(self, point: OperatingPoint, tolerance: float, time: float | Fraction) -> None:
        """Run on with these from `time` [s], the end of the last window.

        Raises:
            ValueError: the speed loop would not be stable there; nothing has changed.
            RunawayError: the run has been stopped.
        """
        if self._failure is not None:
            raise self._failure
        if self.scene.mesh.damping.follows_speed:
            self._speed_loop.check(point)
        cut(self.model, self.march, instant(time))
        clear(self.march.sums.total)
        self.march.sums.taken = self.march.control.step  # what lies before `time`
        self._shown = None
        self.tolerance = tolerance
        self._load(point)

    @property
    def reached(self) -> Fraction:
        """End of the last step [s], at or after the end of the last window."""
        return int(self._end.seconds) + Fraction(float(self._end.time))

    @property
    def control(self) -> Control:
        """Step control and counters."""
        return self.march.control

    @property
    def repeats(self) -> bool:
        """Whether steady running repeats itself, see core/integrators/periodic.hpp."""
        return bool(self._repetition.playing)

    @property
    def powers(self) -> np.ndarray:
        """By which the ledger grows at `reached`."""
        return np.array(self._last.power)

    def take_ledger(self) -> np.ndarray:
        """Integrals of the ledger up to `reached` since they were last taken, see `dynamics.state`.

        They begin anew, so that what a window adds is not lost beside what a long run has added.
        """
        _, end, _ = self._ledgers
        ledger = end.copy()
        for energy in self._ledgers:
            energy -= ledger
        return ledger

    def take_mesh_sums(self, time: float | Fraction) -> MeshSums:
        """Integrals and extremes of the meshes since they were last taken.

        Up to `time` [s], the end of the last window.
        """
        march = self.march
        count_until(self.model, march, delay(march.begin, instant(time)))
        taken = mesh_sums(march.sums.total, int(self.train.meshes))
        clear(march.sums.total)
        return taken

    def stored(self) -> tuple[float, float]:
        """Kinetic and elastic energy at `reached` [J]."""
        moving, strained = stored(self.model, self._end, self._aside)
        return float(moving), float(strained)


def _rows(samples: Samples, begin: int, end: int | None) -> Samples:
    """Some of the samples; what is written there is written into them."""
    return Samples(*(each[begin:end] for each in samples))
