"""A run in progress: the model of a scene, its state, and the integrator.

`Twin` and `simulate` are built on it. It knows bodies and meshes only by their index in arrays;
names and messages belong to the layers above.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import NoReturn

import numpy as np

from .._core import (
    DTE,
    EXCEEDED,
    IMPULSE,
    NO_FINITE_STATE,
    NOT_FINITE,
    Control,
    Model,
    Passages,
    PointLaws,
    Report,
    Train,
    WindowEnd,
)
from ..modal.whirl import whirl_warning
from ..model.bearing_pits import put_depths
from ..model.clock import (
    NEVER,
    TICKS,
    Instant,
    delay,
    instant,
    instant_of_ticks,
    sampling,
)
from ..model.error_scale import new_integrator
from ..model.faults import severity_fields
from ..model.gearbox import Gearbox
from ..model.library import record_in
from ..model.planet_bearings import check_planet_bearings
from ..model.speed_loop_check import SpeedLoopCheck
from ..model.start import start_state
from ..model.teeth import build_tables
from ..scene import OperatingPoint, Scene
from ..scene.severities import with_severities
from .growing import PERIOD, Growing
from .growth_loads import GrowthLoads
from .inputs import Inputs
from .interface import NO_CHANGE
from .limits import Limits, RunawayError
from .samples import Samples, Waves, due_before, new_samples, wave_rows
from .tolerance import check_tolerance
from .warming import Warming
from .window_jobs import WindowJob, WindowJobs, grid

WATCHED = Fraction(1, 10)  # [s] between two checks of a run against its limits
LONGEST_UNWATCHED = float(WATCHED)


class Engine:
    """Integrates a scene from its start.

    Args:
        scene: scene to simulate.
        tolerance: local error of a step, relative to the static deflection of the meshes.
        method: one of METHODS; "march" uses collocation where it is applicable, otherwise
            Rosenbrock's method; "auto" also repeats periodic motion without computing it. Creeping
            gears are always integrated by Rosenbrock's method.

    Raises:
        ValueError: the tolerance is out of range, or the scene cannot be built.
    """

    def __init__(self, scene: Scene, tolerance: float, method: str = "auto") -> None:
        check_tolerance(tolerance)
        self.scene = scene
        self.tolerance = tolerance
        self.gearbox = Gearbox(scene)
        self._growing = Growing(self.gearbox)
        self._growth_loads = GrowthLoads(self.gearbox, self._growing)
        check_planet_bearings(self.gearbox, scene.operating_point)
        self.train, self._core = self.gearbox.train, self.gearbox.core
        self.model: Model = self._core.Model(train=self.train)
        self._train_now = self.train.copy() if self._growing.grows else self.train
        self.integrator = new_integrator(self._core, method)
        # Parts of the integrator that every window reads, because each look-up costs time.
        self._end, self._last = self.integrator.end, self.integrator.last
        self._periodic = self.integrator.periodic
        self._shown: tuple[float | Fraction, Samples] | None = None
        self._limits = Limits(self.gearbox)
        self._failure: RunawayError | None = None
        self._speed_loop = SpeedLoopCheck(self.gearbox)
        for speed in (scene.drive.speed_control.start_speed, scene.operating_point.input_speed):
            if speed is not None:
                where = scene.operating_point.model_copy(update={"input_speed": speed})
                self._speed_loop.check(where)
        may_repeat = method == "auto" and not self._growing.grows
        self._inputs = Inputs(self.gearbox, self.model, self.integrator, may_repeat)
        oil = record_in(self._core, self._inputs.oil)
        self.warming = Warming(self._core, scene, oil) if scene.thermal else None
        """Temperatures; None if the scene gives that of the oil."""
        self._load(scene.operating_point)
        state, unbalanced = start_state(self.gearbox, self.model)
        self.start_warning = unbalanced or whirl_warning(self.gearbox, scene.operating_point)
        self.integrator.begin = self.integrator.end = state
        self._prepare()

    def _prepare(self) -> None:
        """Call functions of a window once; at time zero this changes nothing."""
        self._core.begin_step(self.model, self.integrator)
        self.integrator.end = self.integrator.begin  # tooth pairs may have started to stick
        self.sample(0.0)
        self._core.cut(self.model, self.integrator, instant(0.0))

    def _load(self, point: OperatingPoint) -> None:
        """Put an operating point into the model."""
        self._inputs.put(point, self.tolerance)
        if self.warming is not None:
            self.warming.put_viscosity(self.model.oil)

    def window(
        self, until: int, first: int, rate: float, report: Report, out: Waves, end: WindowEnd
    ) -> WindowJobs:
        """Integrate to `until` [ticks]; fill the waveform, and all that is known at its end.

        Yields the parts of the window, and receives the outcome of each by `send`.

        Raises:
            RunawayError: no step is possible, or a limit is exceeded, see `runaway`.
        """
        if self._failure is not None:
            raise self._failure
        last, done, room = Fraction(until, TICKS), 0, len(out.time)
        self._shown = None

        def part_to(at: Fraction, rows: Waves, closes: bool) -> WindowJobs:
            loads = self._growth_loads.until(at)
            job = WindowJob(
                self.model, self.integrator, instant(at), self._limits.record, report,
                (grid(first + done, rate, rows), *loads), end, closes,
            )  # fmt: skip
            try:
                outcome = yield job
            except KeyboardInterrupt:
                self._end_interrupted()
                raise
            self._watch(outcome, end)
            self._growth_loads.feed(loads)
            if len(rows.time):
                self._watch_axes(rows)
            elif self.gearbox.bearings:
                self.sample(at)  # checks the displacements

        for stop in self._stops(until, instant_of_ticks(until)):
            due = min(max(due_before(stop, rate, first), done), room)
            part = wave_rows(out, done, due)
            yield from part_to(stop, part, False)
            self._pass(stop)
            done = due
        out = wave_rows(out, done, room)
        yield from part_to(last, out, True)
        if self.warming is not None:
            self.warming.add_heat(end)
            if until == self.warming.next:
                self._warm(until)

    def _watch(self, outcome: int, end: WindowEnd) -> None:
        """Stop the run if the core has found no possible step, or has exceeded a limit."""
        try:
            if outcome == NOT_FINITE:
                raise ArithmeticError(NO_FINITE_STATE)
            if outcome == EXCEEDED:
                self._limits.check_window(end, self.model.operation)
        except ArithmeticError as reason:
            self._fail(reason)

    def _watch_axes(self, rows: Waves) -> None:
        """Stop the run if samples exceed a limit of moving axes, which the core does not have."""
        try:
            self._limits.check_waves(rows)
        except ArithmeticError as reason:
            self._fail(reason)

    def _fail(self, reason: ArithmeticError) -> NoReturn:
        if str(reason) == NO_FINITE_STATE:
            try:
                self._limits.check_progress(self.integrator, self.model.operation)
            except ArithmeticError as cause:
                reason = cause
        self._failure = RunawayError(f"the run stops near {float(self.reached):g} s: {reason}")
        raise self._failure from None

    def _end_interrupted(self) -> None:
        """End the run after Ctrl-C within a window, whose samples are lost."""
        where = float(self.reached)
        self._failure = RunawayError(f"the run was interrupted near {where:g} s: start a new one")

    def begin_window(self, time: int, end: WindowEnd) -> None:
        """Begin a window at `time` [ticks], the end of the last one."""
        self._core.begin_window(self.model, self.integrator, instant_of_ticks(time), end)
        self._finish(time, end)

    def exact_end(self, time: int, end: WindowEnd) -> None:
        """Fill `end` as if the last step ended at `time` [ticks], the end of the last window.

        That step is repeated in a copy: the run itself is not changed.
        """
        ended, now = self.integrator.copy(), instant_of_ticks(time)
        self._core.cut(self.model, ended, now)
        self._core.begin_window(self.model, ended, now, end)
        self._finish(time, end)

    def _finish(self, time: int, end: WindowEnd) -> None:
        """Fill turns, angles and all heat since the start of `end` at `time` [ticks]."""
        if self.warming is not None:
            self.warming.add_heat(end)
        sample = self.sample(Fraction(time, TICKS))
        end.turns, end.angle = sample.turns[0], sample.angle[0]

    def _stops(self, until: int, goal: Instant) -> Iterator[Fraction]:
        """Instants [s] before `until` [ticks] at which the core returns, to check limits, say."""
        if self._growing.grows or self.warming is not None:
            stops = set[int]()
            if self._growing.grows:
                stops.update(range(self._growing.next, until, PERIOD))
            if self.warming is not None:
                stops.update(self.warming.instants(until))
            yield from (Fraction(at, TICKS) for at in sorted(stops))
        elif delay(self._end, goal) > LONGEST_UNWATCHED:
            stop = self.reached + WATCHED
            while stop * TICKS < until:
                yield stop
                stop += WATCHED

    def _pass(self, stop: float | Fraction) -> None:
        """Continue after a stop."""
        if self._growing.grows and stop * TICKS == self._growing.next:
            self._grow(Fraction(stop))
        if self.warming is not None and stop * TICKS == self.warming.next:
            self._warm(self.warming.next)

    def _warm(self, ticks: int) -> None:
        """Let the temperatures follow the losses up to `ticks`."""
        assert self.warming is not None
        try:
            if self.warming.warm(self.model, self.integrator, ticks):
                self._shown = None
        except ArithmeticError as reason:
            self._fail(reason)

    def _grow(self, time: Fraction) -> None:
        """Let faults grow at `time` [s]."""
        state, turned = self.integrator.begin, delay(self.integrator.begin, instant(time))
        turns = state.turns + state.fraction + state.speed * turned / (2.0 * math.pi)
        if self._growing.grow(float(self.train.cycle.per_turn @ turns)):
            fields = severity_fields(self._with(NO_CHANGE), build_tables(self.scene))
            for name, value in fields.items():
                setattr(self._train_now.faults, name, value)
            put_depths(self._with(NO_CHANGE), self._train_now.moving)
            self._put_train(self._train_now, time)

    def _with(self, severities: Mapping[str, float]) -> Scene:
        """The scene with the present severities, and with others by name."""
        faults = with_severities(self.scene.faults, {**self._growing.values, **severities})
        return self.scene.model_copy(update={"faults": faults})

    def _put_train(self, train: Train, time: float | Fraction) -> None:
        """Continue with other severities from `time` [s]."""
        self._train_now = train
        try:
            self._core.change_train(self.model, self.integrator, instant(time), train)
        except ArithmeticError as reason:
            self._fail(reason)
        self._shown = None

    @property
    def severities(self) -> Mapping[str, float]:
        """Present severities of the faults by dotted name."""
        return self._growing.values

    def sample(self, time: float | Fraction) -> Samples:
        """One sample at `time` [s], to which the run is advanced if it has not reached it.

        Raises:
            RunawayError: no step is possible, or a limit is exceeded, see `runaway`.
        """
        if self._shown is not None and self._shown[0] == time:
            return self._shown[1]
        if self._failure is not None:
            raise self._failure
        samples, at = new_samples(self.train, 1), sampling(1, 1.0)
        try:
            self._core.advance(self.model, self.integrator, instant(time), NEVER, at, samples)
            self._check(samples)
        except KeyboardInterrupt:
            self._end_interrupted()
            raise
        except ArithmeticError as reason:
            self._fail(reason)
        self._shown = time, samples
        return samples

    def _check(self, samples: Samples) -> None:
        """Raise an `ArithmeticError` if the train exceeds a limit."""
        limits, power = self._limits, np.array(self._last.power)
        limits.check_deflection(np.abs(samples.mesh[0, DTE]), self.model.operation)
        limits.check_displacements(samples.moved, samples.tilting)
        limits.speed.check(samples.speed)
        limits.torque.check(power[None, IMPULSE : IMPULSE + int(self.train.machines)])

    def change(
        self,
        point: OperatingPoint,
        tolerance: float,
        time: float | Fraction,
        severities: Mapping[str, float] = NO_CHANGE,
    ) -> None:
        """Continue with other inputs from `time` [s], the end of the last window.

        Args:
            point: operating point.
            tolerance: relative local error tolerance.
            time: end of the last window [s].
            severities: other severities of faults, by dotted name.

        Raises:
            ValueError: the speed loop would not be stable, bearings of planets are too soft, or
                a tooth cannot have a fault; nothing has changed.
            RunawayError: the run has been stopped.
        """
        if self._failure is not None:
            raise self._failure
        faulty = Gearbox(self._with(severities)) if severities else None
        train = self._train_now if faulty is None else faulty.train
        check_planet_bearings(self.gearbox, point)
        if self.scene.mesh.damping.follows_speed:
            self._speed_loop.check(point)
        self._end_step(time)
        if faulty is not None:
            self._limits = Limits(faulty)
            self._growing.set(severities)
            self._put_train(train, time)
        if self.warming is not None and point.ambient_temperature != self.warming.network.ambient:
            self._warm(int(time * TICKS))
            self.warming.surround(point)
        self.tolerance = tolerance
        self._load(point)

    def _end_step(self, time: float | Fraction) -> None:
        """End the last step at `time` [s], the end of the last window, and the ledger with it."""
        self._core.cut(self.model, self.integrator, instant(time))
        self.integrator.sums.total = self._core.MeshSums()
        self.integrator.sums.taken = self.integrator.control.step  # what lies before `time`
        self._shown = None

    @property
    def reached(self) -> Fraction:
        """End of the last step [s], at or after the end of the last window."""
        return int(self._end.seconds) + Fraction(float(self._end.time))

    @property
    def laws(self) -> PointLaws:
        """How the loads depend on the operating point."""
        return self.gearbox.laws

    @property
    def control(self) -> Control:
        """Step control and counters."""
        return self.integrator.control

    @property
    def passages(self) -> Passages:
        """Peaks of the tooth pairs in mesh and turning points of the torques of shafts so far."""
        return self.integrator.passages

    @property
    def repeats(self) -> bool:
        """Whether mesh cycles are repeated, see core/integrators/periodic.hpp."""
        return bool(self._periodic.replaying)
