"""A quasi-static run in progress, with the interface of `Engine`."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np

from ..._core import (
    COAST_SIDE,
    DRIVE_SIDE,
    LEDGER,
    MESH_FORCE,
    WAVEFORM,
    Control,
    Load,
    Model,
    Oil,
    Report,
    State,
    WindowEnd,
)
from ...model.clock import TICKS, delay, instant, sampling
from ...model.gearbox import Gearbox
from ...model.layout import MOTOR
from ...model.library import record_in
from ...model.mesh_sums import MeshSums, mesh_sums, record_of
from ...model.oil import build_oil
from ...model.planet_bearings import check_planet_bearings
from ...scene import OperatingPoint, Scene
from ..axes.motion import axes_motion, joined_flanks
from ..energy import EnergyBooks
from ..limits import Limits, RunawayError
from ..samples import Samples, Waves, new_samples
from ..tolerance import check_tolerance
from ..window_jobs import WindowJobs
from .ledger import Ledger
from .second_coupling import check_second_coupling
from .totals import ENERGY


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
        # Nothing vibrates, so damping has no effect.
        still = scene.replace(**{"mesh.damping.law": "viscous", "mesh.damping.damping_ratio": 0.0})
        self.train = Gearbox(still).train
        self.start_warning = ""  # without equilibrium there is no run
        self._limits = Limits(self.gearbox)
        self.control = Control()
        self.reached = Fraction(0)
        self.repeats = False  # mesh cycles are never repeated
        self._load(scene.operating_point, tolerance, self._start(), np.zeros(LEDGER))

    def _start(self) -> State:
        control, point = self.scene.drive.speed_control, self.scene.operating_point
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
        load: Load = record_in(self._core, self.gearbox.load(point))
        oil: Oil = record_in(self._core, build_oil(self.scene, point))
        model: Model = self._core.Model(train=self.train, oil=oil, load=load)
        force = self.gearbox.mesh_force(float(load.torque[MOTOR]))
        closing_side = DRIVE_SIDE if force >= 0.0 else COAST_SIDE
        check_second_coupling(self._core, model, tolerance, closing_side, origin)
        ledger = Ledger(self._core, model, tolerance, closing_side, origin, energy)
        self.model, self.tolerance, self._closing_side, self._ledger = (
            model,
            tolerance,
            closing_side,
            ledger,
        )
        self._origin, self._run = origin.copy(), self._core.first_guess(closing_side)
        self._both_flanks = self.control.both_flanks  # before this operating point

    def advance(
        self, until: float | Fraction, first_sample: int, sample_rate: float, room: int
    ) -> Samples:
        """Run to `until` [s]; samples lie at whole multiples of 1/sample_rate.

        Returns `room` samples from number `first_sample` on. A time given as a fraction is exact
        at any age of the run.

        Raises:
            RunawayError: the deflection of the teeth exceeds its limit, see `runaway`.
        """
        samples = new_samples(self.train, room)
        at = sampling(first_sample, sample_rate)
        self._core.sample_equilibria(
            self.model, self.tolerance, self._origin, self._run, at, samples
        )
        try:
            self._limits.check_deflection(samples, self.model.load)
            self._limits.check_displacements(samples.moved, samples.tilting)
        except ArithmeticError as reason:
            raise RunawayError(f"the run stops before {float(until):g} s: {reason}") from None
        self._core.advance_origin(self.model, self._origin, instant(until))
        self.reached = Fraction(until)
        self._count()
        return samples

    def window(
        self, until: int, first: int, rate: float, report: Report, out: Waves, end: WindowEnd
    ) -> WindowJobs:
        """Run to `until` [ticks]; fill the waveform, and all that is known at its end.

        Raises:
            RunawayError: the deflection of the teeth exceeds its limit, see `runaway`.
        """
        time, rows = Fraction(until, TICKS), len(out.time)
        samples, place = self.advance(time, first, rate, rows), report.mesh[: report.meshes]
        moving = self.scene.moving_axes
        shown = joined_flanks(samples.mesh, place) if moving else samples.mesh[:, :, place]
        out.time[:] = np.arange(first, first + rows) / rate
        for values, (first_row, last_row) in zip(out.mesh, WAVEFORM.values(), strict=True):
            values[:] = shown[:, first_row : last_row + 1].sum(axis=1)
        if moving and rows:
            self._put_axes(samples, place, out)
        self.begin_window(until, end)
        end.sums = record_of(self.pop_mesh_sums(time), self._core)
        yield from ()  # all is done here: there are no jobs

    def _put_axes(self, samples: Samples, place: np.ndarray, out: Waves) -> None:
        """Fill what a waveform has of axes that move."""
        ratio = self.train.ratio[self.train.carrier]
        angle = 2.0 * np.pi * samples.turns @ ratio
        if self.train.carrier < self.train.bodies:
            angle = angle + samples.angle[:, self.train.carrier]
        force = np.abs(samples.mesh[:, MESH_FORCE]).mean(axis=0)[place]
        found, rows = axes_motion(self.scene, samples, place, angle, force), len(samples.turns)
        out.displacement[:] = found.displacement.reshape(rows, -1)
        out.bearing_force[:] = found.bearing_force.reshape(rows, -1)
        out.orbit[:] = found.orbit.reshape(rows, -1)
        out.flank_force[:] = found.flank_force.reshape(rows, -1)
        out.tilting[:] = samples.tilting.reshape(rows, -1)

    def begin_window(self, time: int, end: WindowEnd) -> None:
        """Begin a window at `time` [ticks], the end of the last one."""
        end.ledger, end.power = self.pop_energy_ledger(), self.powers
        end.kinetic, end.elastic = self._stored(self.reached)
        sample = self.sample(Fraction(time, TICKS))
        end.turns, end.angle = sample.turns[0], sample.angle[0]

    def sample(self, time: float | Fraction) -> Samples:
        """One sample at `time` [s], the end of the last window."""
        samples, run = new_samples(self.train, 1), self._core.first_guess(self._closing_side)
        at = instant(time)
        self._core.sample_equilibrium(self.model, self.tolerance, self._origin, run, at, samples, 0)
        return samples

    def change(self, point: OperatingPoint, tolerance: float, time: float | Fraction) -> None:
        """Continue with this point and tolerance from `time` [s], the end of the last window.

        Raises:
            ValueError: there is no equilibrium; nothing has changed.
        """
        check_planet_bearings(self.gearbox, point)
        energy = self._ledger.at(instant(time))[0][ENERGY]
        self._load(point, tolerance, self._standing(time), energy)

    def _standing(self, time: float | Fraction) -> State:
        state = self._origin.copy()
        self._core.advance_shafts(
            self.model, self._origin, delay(self._origin, instant(time)), state
        )
        return state

    def books(self, time: float | Fraction) -> EnergyBooks:
        """Energy at `time` [s], the end of the last window; the ledger is that since it was taken.

        The elastic energy is not modelled.
        """
        energy = self._ledger.at(instant(time))[0][ENERGY].copy()
        self._count()
        return EnergyBooks(energy, *self._stored(time))

    def pop_energy_ledger(self) -> np.ndarray:
        """Integrals of the ledger from the previous call to `reached`, see core/model/energy.hpp.

        They restart at zero, so that rounding does not grow with the length of the run.
        """
        energy = self._ledger.pop_energy(instant(self.reached))
        self._count()
        return energy

    def pop_mesh_sums(self, time: float | Fraction) -> MeshSums:
        """Integrals and extremes of the meshes from the previous call to `time` [s].

        `time` is the end of the last window.
        """
        sums = self._ledger.pop_mesh_sums(instant(time))
        if not self.scene.moving_axes:
            return sums
        record = record_of(sums, self._core)
        self._core.join_flanks(self.train, record)
        return mesh_sums(record, int(self.train.meshes))

    def _count(self) -> None:
        """Update the counters of the run."""
        self.control.both_flanks = (
            self._both_flanks + self._run.both_flanks + self._ledger.both_flanks
        )

    @property
    def powers(self) -> np.ndarray:
        """Time derivative of the ledger [W] at `reached`."""
        return self._ledger.power(instant(self.reached))

    def _stored(self, time: float | Fraction) -> tuple[float, float]:
        """Kinetic energy at `time` [J], and potential energy of the weight of the planets."""
        standing = self._standing(time)
        lifted = self._core.weight_energy(self.train, standing)
        return self._core.kinetic(self.model, standing), lifted
