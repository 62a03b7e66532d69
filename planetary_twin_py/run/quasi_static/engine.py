"""A quasi-static run in progress, with the interface of `Engine`."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

import numpy as np

from ..._core import (
    COAST_SIDE,
    DRIVE_SIDE,
    HEAT,
    HEATS,
    LEDGER,
    Control,
    Model,
    Oil,
    Operation,
    Passages,
    Report,
    State,
    Train,
    WindowEnd,
)
from ...model.clock import TICKS, delay, instant
from ...model.gearbox import Gearbox
from ...model.layout import MOTOR
from ...model.library import record_in
from ...model.oil import build_oil
from ...model.planet_bearings import check_planet_bearings
from ...scene import OperatingPoint, Scene
from ..interface import NO_CHANGE
from ..limits import Limits, RunawayError
from ..samples import Samples, Waves, due_before, new_samples, wave_rows
from ..tolerance import check_tolerance
from ..warming import Warming
from ..window_jobs import WindowJobs, grid
from .ledger import ENERGY, Ledger
from .passage_ledger import AtPoint
from .second_coupling import check_second_coupling


class QuasiStaticEngine:
    """Simulates a scene whose bodies turn rigidly under static loads.

    Args:
        scene: what to simulate.
        tolerance: relative error of mesh forces, and of the losses of a mesh cycle.

    Raises:
        ValueError: the tolerance is out of range, or the scene cannot be built.
    """

    def __init__(self, scene: Scene, tolerance: float) -> None:
        check_tolerance(tolerance)
        self.scene = scene
        self.gearbox = Gearbox(scene)
        check_planet_bearings(self.gearbox, scene.operating_point)
        self._core = self.gearbox.core
        self.passages: Passages = self._core.Passages()
        """Peaks of the tooth pairs in mesh and turning points of the torques of shafts so far."""
        self.severities: Mapping[str, float] = scene.severities
        """Present severities of the faults by dotted name."""
        self.train = self._train()
        self.start_warning = ""  # without equilibrium there is no run
        self._limits = Limits(self.gearbox)
        self.control = Control()
        self.reached = Fraction(0)
        self.repeats = False  # mesh cycles are never repeated
        oil = record_in(self._core, build_oil(scene, scene.operating_point))
        self.warming = Warming(self._core, scene, oil) if scene.thermal else None
        """Temperatures; None if the scene gives that of the oil."""
        self._load(
            scene.operating_point, tolerance, self._start(scene.operating_point), np.zeros(LEDGER)
        )

    def _train(self) -> Train:
        """Train with the present severities; nothing vibrates, so damping has no effect."""
        still = {"mesh.damping.law": "viscous", "mesh.damping.damping_ratio": 0.0}
        return Gearbox(self.scene.replace(**still, **self.severities)).train

    def start_again(self, point: OperatingPoint) -> None:
        """Start again in steady running at an operating point, at the present temperatures.

        Raises:
            ValueError: there is no equilibrium; nothing has changed.
        """
        self._load(point, self.tolerance, self._start(point), np.zeros(LEDGER))

    def _start(self, point: OperatingPoint) -> State:
        control = self.scene.drive.speed_control
        speeds = [point.input_speed, point.second_input_speed]
        if control.start_speed is not None:
            speeds[0] = control.start_speed
        axes = self.train.axes
        return self._state(speed=speeds[:axes], set_speed=speeds[:axes])

    def _state(self, **fields: Any) -> State:
        state: State = self._core.State(**fields)
        return state

    def _load(
        self, point: OperatingPoint, tolerance: float, origin: State, energy: np.ndarray
    ) -> None:
        """Continue from `origin` at an operating point, with `energy` in the ledger.

        If there is no equilibrium, nothing changes.
        """
        operation: Operation = record_in(self._core, self.gearbox.operation(point))
        oil: Oil = record_in(self._core, build_oil(self.scene, point))
        if self.warming is not None:
            self.warming.put_viscosity(oil)
        model: Model = self._core.Model(train=self.train, oil=oil, operation=operation)
        force = self.gearbox.mesh_force(float(operation.torque[MOTOR]))
        closing_side = DRIVE_SIDE if force >= 0.0 else COAST_SIDE
        check_second_coupling(self._core, model, tolerance, closing_side, origin)
        at_point = AtPoint(self._core, model, tolerance, closing_side)
        ledger = Ledger(at_point, origin, energy, self.passages)
        self.model, self.tolerance = model, tolerance
        self._closing_side, self._ledger = closing_side, ledger
        self._point = point
        self._heat = ledger.beside() if self.warming is not None else None
        self._heat_taken = np.zeros(HEATS)  # [J] of that ledger
        self._origin, self._run = origin.copy(), self._core.first_guess(closing_side)
        self._both_flanks = self.control.both_flanks  # before this operating point

    def window(
        self, until: int, first: int, rate: float, report: Report, out: Waves, end: WindowEnd
    ) -> WindowJobs:
        """Run to `until` [ticks]; fill what `out` asks for, and all that is known at its end.

        Raises:
            RunawayError: the deflection of the teeth exceeds its limit, see `runaway`.
        """
        done, room = 0, len(out.time)
        for stop in () if self.warming is None else self.warming.instants(until):
            due = min(max(due_before(Fraction(stop, TICKS), rate, first), done), room)
            self._sample(stop, first + done, rate, report, wave_rows(out, done, due), end)
            self._warm(stop)
            done = due
        self._sample(until, first + done, rate, report, wave_rows(out, done, room), end)
        self.reached = Fraction(until, TICKS)
        self._core.advance_origin(self.model, self._origin, instant(self.reached))
        self.begin_window(until, end)
        self._ledger.pop_mesh_sums(instant(self.reached), end.sums)
        if self.scene.moving_axes:
            self._core.join_flanks(self.train, end.sums)
        self._count()
        if self.warming is not None and until == self.warming.next:
            self._warm(until)
        yield from ()  # all is done here: there are no jobs

    def _sample(
        self, until: int, first: int, rate: float, report: Report, out: Waves, end: WindowEnd
    ) -> None:
        """Fill the samples of a part of a window, which ends at `until` [ticks]."""
        samples = grid(first, rate, out)
        self._core.sample_window(
            self.model, self.tolerance, self._origin, self._run, report, samples, end
        )
        try:
            self._limits.check_deflection(end.peaks.dte[: self.train.meshes], self.model.operation)
            self._limits.check_waves(out)
        except ArithmeticError as reason:
            time = f"{until / TICKS:g} s"
            raise RunawayError(f"the run stops before {time}: {reason}") from None

    def _warm(self, ticks: int) -> None:
        """Let the temperatures follow the losses up to `ticks`."""
        assert self.warming is not None
        assert self._heat is not None
        time = Fraction(ticks, TICKS)
        heat = self._heat.at(instant(time))[0][HEAT:LEDGER]
        taken, self._heat_taken = heat - self._heat_taken, heat.copy()
        try:
            if self.warming.take(taken, ticks):
                energy = self._ledger.at(instant(time))[0][ENERGY]
                self._load(self._point, self.tolerance, self._standing(time), energy)
        except ArithmeticError as reason:
            raise RunawayError(f"the run stops near {ticks / TICKS:g} s: {reason}") from None

    def begin_window(self, time: int, end: WindowEnd) -> None:
        """Begin a window at `time` [ticks], the end of the last one."""
        self._fill_end(time, self._ledger.pop_energy(instant(self.reached)), end)

    def exact_end(self, time: int, end: WindowEnd) -> None:
        """Fill `end` at `time` [ticks], the end of the last window; it changes nothing."""
        self._fill_end(time, self._ledger.at(instant(self.reached))[0][ENERGY], end)

    def _fill_end(self, time: int, ledger: np.ndarray, end: WindowEnd) -> None:
        """Fill `end` at `time` [ticks]; the elastic energy is not modelled."""
        end.ledger, end.power = ledger, self._ledger.power(instant(self.reached))
        end.kinetic, end.elastic = self._stored(self.reached)
        sample = self.sample(Fraction(time, TICKS))
        end.turns, end.angle = sample.turns[0], sample.angle[0]
        self._count()

    def sample(self, time: float | Fraction) -> Samples:
        """One sample at `time` [s], the end of the last window."""
        samples, run = new_samples(self.train, 1), self._core.first_guess(self._closing_side)
        at = instant(time)
        self._core.sample_equilibrium(self.model, self.tolerance, self._origin, run, at, samples, 0)
        return samples

    def change(
        self,
        point: OperatingPoint,
        tolerance: float,
        time: float | Fraction,
        severities: Mapping[str, float] = NO_CHANGE,
    ) -> None:
        """Continue with these inputs from `time` [s], the end of the last window.

        Raises:
            ValueError: there is no equilibrium, or a tooth cannot have a fault; nothing has
                changed.
        """
        check_planet_bearings(self.gearbox, point)
        if self.warming is not None and point.ambient_temperature != self.warming.network.ambient:
            self._warm(int(time * TICKS))
            self.warming.surround(point)
        energy = self._ledger.at(instant(time))[0][ENERGY]
        before = self.severities, self.train
        try:
            if severities:
                self.severities = {**self.severities, **severities}
                self.train = self._train()
            self._load(point, tolerance, self._standing(time), energy)
        except ValueError:
            self.severities, self.train = before
            raise

    @property
    def ahead(self) -> float:
        """Mesh cycles by which the loaded train is ahead of the angles of samples, at the start.

        They are those of the rigid frame, without the twist of couplings and teeth.
        """
        run = self._core.first_guess(self._closing_side)
        self._core.advance_shafts(self.model, self._origin, 0.0, run.state)
        self._core.solve_equilibrium(self.model, self.tolerance, run)
        return float(self._core.cycle_shift(self.train, run.state.x))

    def mean_heat(self) -> np.ndarray:
        """Mean heat by source in a mesh cycle of steady running from now on [W], (sources,)."""
        rate = abs(self._core.frame_cycle_rate(self.train, self._origin))
        if rate == 0.0:
            return np.zeros(HEATS)
        ahead = instant(self.reached + Fraction(1.0 / rate))
        return np.asarray(self._ledger.beside().at(ahead)[0][HEAT:LEDGER] * rate)

    def _standing(self, time: float | Fraction) -> State:
        state = self._origin.copy()
        self._core.advance_shafts(
            self.model, self._origin, delay(self._origin, instant(time)), state
        )
        return state

    def _count(self) -> None:
        """Update the counters of the run."""
        self.control.both_flanks = (
            self._both_flanks + self._run.both_flanks + self._ledger.both_flanks
        )

    def _stored(self, time: float | Fraction) -> tuple[float, float]:
        """Kinetic energy at `time` [J], and potential energy of the weight of the planets."""
        standing = self._standing(time)
        lifted = self._core.weight_energy(self.train, standing)
        return self._core.kinetic(self.model, standing), lifted
