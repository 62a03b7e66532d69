"""A quasi-static run in progress, with the interface of `Engine`."""

from __future__ import annotations

from fractions import Fraction

import numpy as np

from .._core import (
    BOUNDARY,
    COAST_SIDE,
    DRIVE_SIDE,
    DTE,
    LEDGER,
    MESH_FORCE,
    VISCOUS,
    Control,
    Model,
    Report,
    State,
    WindowEnd,
    first_guess,
    kinetic,
    roll,
    sample_equilibria,
    sample_equilibrium,
    turn_to,
)
from ..dynamics.bodies import MOTOR
from ..dynamics.mesh_sums import MeshSums, record_of
from ..dynamics.oil import build_oil
from ..dynamics.start import build_load
from ..dynamics.static_load import mesh_force
from ..dynamics.train import build_train
from ..integrators.clock import TICKS, delay, instant, sampling
from ..integrators.interpolant import Samples, Waves, new_samples
from ..runaway import Limits, RunawayError
from ..scene import OperatingPoint, Scene
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
        # Nothing vibrates, so damping has no effect.
        still = scene.replace(**{"mesh.damping.law": "viscous", "mesh.damping.damping_ratio": 0.0})
        self.train = build_train(still)
        self._limits = Limits(scene, self.train)
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
        return State(speed=speeds[:axes], set_speed=speeds[:axes])

    def _load(
        self, point: OperatingPoint, tolerance: float, origin: State, energy: np.ndarray
    ) -> None:
        """Continue from `origin` at an operating point, with `energy` in the ledger.

        If there is no equilibrium, nothing changes.
        """
        load, oil = build_load(self.scene, point, self.train), build_oil(self.scene, point)
        model = Model(train=self.train, oil=oil, load=load)
        lean = (
            DRIVE_SIDE if mesh_force(self.scene, float(load.torque[MOTOR])) >= 0.0 else COAST_SIDE
        )
        check_second_coupling(model, tolerance, lean, origin)
        ledger = Ledger(model, tolerance, lean, origin, energy)
        self.model, self.tolerance, self._lean, self._ledger = model, tolerance, lean, ledger
        self._origin, self._run = origin.copy(), first_guess(lean)
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
        sample_equilibria(self.model, self.tolerance, self._origin, self._run, at, samples)
        try:
            self._limits.check_squeeze(samples, self.model.load)
        except ArithmeticError as reason:
            raise RunawayError(f"the run stops before {float(until):g} s: {reason}") from None
        roll(self.model, self._origin, instant(until))
        self.reached = Fraction(until)
        self._count()
        return samples

    def window(
        self, until: int, first: int, rate: float, report: Report, out: Waves, end: WindowEnd
    ) -> WindowJobs:
        """Run to `until` [ticks]; fill the waveform, and all that is known at its end.

        Raises:
            RunawayError: the teeth yield more than they can, see `runaway`.
        """
        time, rows = Fraction(until, TICKS), len(out.time)
        shown = self.advance(time, first, rate, rows).mesh[:, :, report.mesh[: report.meshes]]
        out.time[:] = np.arange(first, first + rows) / rate
        out.dte[:], out.mesh_force[:] = shown[:, DTE], shown[:, MESH_FORCE]
        out.friction[:] = shown[:, BOUNDARY] + shown[:, VISCOUS]
        self.stand(until, end)
        end.sums = record_of(self.take_mesh_sums(time))
        yield from ()  # all is done here: there are no jobs

    def stand(self, time: int, end: WindowEnd) -> None:
        """Begin a window at `time` [ticks], the end of the last one."""
        seconds, rest = divmod(self.reached, 1)
        end.seconds, end.time = seconds, float(rest)
        end.time_rest = float(rest - Fraction(end.time))
        end.ledger, end.power = self.take_ledger(), self.powers
        end.kinetic, end.elastic = self.stored()
        sample = self.sample(Fraction(time, TICKS))
        end.turns, end.angle = sample.turns[0], sample.angle[0]

    def sample(self, time: float | Fraction) -> Samples:
        """One sample at `time` [s], the end of the last window."""
        samples, run = new_samples(self.train, 1), first_guess(self._lean)
        at = instant(time)
        sample_equilibrium(self.model, self.tolerance, self._origin, run, at, samples, 0)
        return samples

    def change(self, point: OperatingPoint, tolerance: float, time: float | Fraction) -> None:
        """Continue with this point and tolerance from `time` [s], the end of the last window.

        Raises:
            ValueError: there is no equilibrium; nothing has changed.
        """
        energy = self._ledger.at(instant(time))[0][ENERGY]
        self._load(point, tolerance, self._standing(time), energy)

    def _standing(self, time: float | Fraction) -> State:
        state = self._origin.copy()
        turn_to(self.model, self._origin, delay(self._origin, instant(time)), state)
        return state

    def take_ledger(self) -> np.ndarray:
        """Integrals of the ledger from the previous call to `reached`, see core/train/energy.hpp.

        They restart at zero, so that rounding does not grow with the length of the run.
        """
        energy = self._ledger.take(instant(self.reached))
        self._count()
        return energy

    def take_mesh_sums(self, time: float | Fraction) -> MeshSums:
        """Integrals and extremes of the meshes from the previous call to `time` [s].

        `time` is the end of the last window.
        """
        return self._ledger.take_mesh_sums(instant(time))

    def _count(self) -> None:
        """Update the counters of the run."""
        self.control.both_flanks = (
            self._both_flanks + self._run.both_flanks + self._ledger.both_flanks
        )

    @property
    def powers(self) -> np.ndarray:
        """Time derivative of the ledger [W] at `reached`."""
        return self._ledger.power(instant(self.reached))

    def stored(self) -> tuple[float, float]:
        """Kinetic and elastic energy at `reached` [J]; the elastic energy is not modelled, so 0."""
        return kinetic(self.model, self._standing(self.reached)), 0.0
