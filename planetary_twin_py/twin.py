"""A simulation that advances in windows and whose inputs can be changed between them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from ._core import (
    BEARING,
    BOUNDARY,
    CHURNING,
    DAMPING,
    DTE,
    FRICTION,
    IMPULSE,
    MESH_FORCE,
    STIFFNESS_WORK,
    VISCOUS,
    WORK,
)
from .accuracy import Course, Settling, course_so_far, unsettled
from .dynamics.bodies import Ratios, body_names, mesh_names
from .dynamics.mesh_sums import in_order
from .gearset.kinematics import mesh_frequency
from .integrators.interpolant import Samples
from .run import start
from .runaway import RunawayError
from .scene import TUNABLES, OperatingPoint, Scene, SceneError
from .tolerance import LIVE_TOLERANCE, check_tolerance
from .window import Waveform, Window, mesh_statistics

TICKS = 10**12  # of the clock per second
LEEWAY = Fraction(1, 10**6)  # sample periods by which a sample may exceed the window
LONGEST_WINDOW = 60.0  # [s], because samples are kept in memory; or
MOST_SAMPLES = 4096  # samples, if that is longer
LOWEST_SAMPLE_RATE = 1.0  # [Hz]


class Change(NamedTuple):
    """Inputs of a run from a certain time on."""

    time: float
    """Simulated time from which they apply [s]."""
    point: OperatingPoint
    """Operating point."""
    tolerance: float
    """Relative local error tolerance."""
    sample_rate: float
    """Of the waveform [Hz]; it does not affect the motion."""


class Twin:
    """A running gearbox whose operating point can be changed between windows.

    The equations of motion are those of `simulate`; their sources are in docs/model.md.

    Args:
        scene: the scene; the run starts in a steady state at its operating point.
        sample_rate: of the waveform [Hz].
        tolerance: relative local error tolerance; the default is suitable for real time.

    Raises:
        ValueError: the scene, the sample rate or the tolerance is invalid.
    """

    def __init__(
        self, scene: Scene, sample_rate: float = 50_000.0, tolerance: float = LIVE_TOLERANCE
    ) -> None:
        _check_sample_rate(sample_rate)
        self.scene = scene
        self._names, self._mesh_names = body_names(scene), mesh_names(scene)
        self._engine = start(scene, tolerance)
        train = self._engine.train
        self._ratio = train.ratio[: train.bodies].T
        self._shafts = train.coupling[: train.machines, 0]
        self._machines = int(train.machines)
        self._whole_turns = _WholeTurns(self._names.ratio)
        self._clock = Fraction(0)
        self.log = [Change(0.0, scene.operating_point, tolerance, float(sample_rate))]
        """All changes. Applied at the same times, they reproduce the run and its samples."""
        self._books = self._account()
        self._end = self._engine.sample(self._clock)
        self._forgetting, self._settled = Settling(scene), 0.0
        self._settling = self._forgetting.rate(scene.operating_point)
        self._course = course_so_far(self._engine.control, 0.0)

    @property
    def bodies(self) -> tuple[str, ...]:
        """Names of the bodies, in the order of arrays over bodies."""
        return self._names.names

    @property
    def meshes(self) -> tuple[str, ...]:
        """Names of the meshes, in the order of arrays over meshes."""
        return self._mesh_names.names

    @property
    def time(self) -> float:
        """Simulated time [s]: the end of the last window."""
        return float(self._clock)

    @property
    def operating_point(self) -> OperatingPoint:
        """Current operating point."""
        return self.log[-1].point

    @property
    def tolerance(self) -> float:
        """Current relative local error tolerance."""
        return self.log[-1].tolerance

    @property
    def sample_rate(self) -> float:
        """Current sample rate of the waveform [Hz]."""
        return self.log[-1].sample_rate

    def set(self, **changes: float) -> float:
        """Change fields of the operating point at the current time.

        Args:
            changes: values in SI by field name.

        Returns:
            The simulated time from which they apply [s].

        Raises:
            ValueError: a name is unknown, or a value is out of range; no field is changed.
        """
        for name in changes:
            if name not in TUNABLES:
                raise SceneError(f"{name}: no such field")
        point = self.scene.point_with(self.operating_point, changes)
        return self._change(point, self.tolerance)

    def set_tolerance(self, tolerance: float) -> float:
        """Change the tolerance at the current time.

        Args:
            tolerance: relative local error tolerance.

        Returns:
            The simulated time from which it applies [s].

        Raises:
            ValueError: the value is out of range; it is not changed.
        """
        check_tolerance(tolerance)
        return self._change(self.operating_point, tolerance)

    def set_sample_rate(self, sample_rate: float) -> float:
        """Change the sample rate of the waveform at the current time; the motion is not affected.

        Args:
            sample_rate: [Hz]; sample times are integer multiples of the new period.

        Returns:
            The simulated time from which it applies [s].

        Raises:
            ValueError: the value is out of range; it is not changed.
        """
        _check_sample_rate(sample_rate)
        if sample_rate != self.sample_rate:
            last = self.log[-1]
            self.log.append(last._replace(time=self.time, sample_rate=float(sample_rate)))
        return self.time

    def advance(self, duration: float) -> Window:
        """Simulate one window.

        Args:
            duration: simulated time [s], above 0 and at most 60 s or 4096 samples, whichever is
                longer.

        Returns:
            Statistics and waveform of the window.

        Raises:
            ValueError: the duration is out of range.
            RunawayError: the run exceeds physical limits; the twin cannot be advanced further.
        """
        longest = max(LONGEST_WINDOW, MOST_SAMPLES / self.sample_rate)
        if not 0.0 < duration <= longest:
            raise ValueError(f"duration = {duration!r} s: must be above 0 and at most {longest:g}")
        # Exact, so that rounding errors do not accumulate and windows of 10 ms end on samples.
        step = Fraction(round(duration * TICKS), TICKS)
        if not step:
            raise ValueError(f"duration = {duration!r} s: must be at least 1e-12, the clock's step")
        first = self._samples() + 1
        self._clock += step
        room = self._samples() - first + 1
        repeated = self._engine.repeats
        try:
            samples = self._engine.advance(self._clock, first, self.sample_rate, room)
        except RunawayError:
            self._clock -= step  # the last completed window remains valid
            raise
        return self._window(step, first, samples, repeated)

    def _change(self, point: OperatingPoint, tolerance: float) -> float:
        change = Change(self.time, point, tolerance, self.sample_rate)
        if change[1:] != self.log[-1][1:]:
            self._engine.change(point, tolerance, self._clock)
            self._books = self._account()  # a change of backlash is not work of this window
            self._end = self._engine.sample(self._clock)  # with the new operating point
            self._settling = self._forgetting.rate(point)
            self.log.append(change)
        return self.time

    def _samples(self) -> int:
        """Number of samples up to the current time."""
        over, under = self.sample_rate.as_integer_ratio()
        clock, leeway = self._clock, LEEWAY
        ticks = clock.numerator * over * leeway.denominator
        whole = clock.denominator * under  # in integers: fractions would be reduced at every step
        return (ticks + leeway.numerator * whole) // (whole * leeway.denominator)

    def _account(self) -> tuple[Fraction, np.ndarray, float]:
        """Time reached by the integrator, ledger since the last call, and stored energy."""
        return self._engine.reached, self._engine.take_ledger(), sum(self._engine.stored())

    def _window(self, step: Fraction, first: int, samples: Samples, repeated: bool) -> Window:
        before, begin = self._books, self._end
        self._books, self._end = self._account(), self._engine.sample(self._clock)
        names = self._names
        elapsed = float(self._books[0] - before[0])
        if elapsed > 0.0:
            rate = self._books[1] / elapsed
            stored = (self._books[2] - before[2]) / elapsed
        else:  # a window within one step
            rate, stored = self._engine.powers, float("nan")
        turned = 2.0 * math.pi * (self._end.turns - begin.turns) @ self._ratio
        speed = ((turned + self._end.angle - begin.angle) / float(step))[0]
        mean_speed = np.append(speed, 0.0)[names.place]
        sun, carrier = mean_speed[names.names.index("sun")], mean_speed[-1]
        place, mesh = self._mesh_names.place, samples.mesh
        sums = in_order(self._engine.take_mesh_sums(self._clock), place)
        return Window(
            start=float(self._clock - step),
            end=self.time,
            tolerance=self.tolerance,
            sample_rate=self.sample_rate,
            repeated=repeated,
            bodies=names.names,
            meshes=self.meshes,
            waveform=Waveform(
                period=1.0 / self.sample_rate,
                time=(first + np.arange(len(mesh))) / self.sample_rate,
                dte=mesh[:, DTE][:, place],
                mesh_force=mesh[:, MESH_FORCE][:, place],
                friction=(mesh[:, BOUNDARY] + mesh[:, VISCOUS])[:, place],
            ),
            mesh=mesh_statistics(sums),
            angle=self._angles(),
            mean_speed=mean_speed,
            mesh_frequency=mesh_frequency(self.scene.gearset.tooth_numbers, sun, carrier),
            machine_speed=speed[self._shafts],
            machine_torque=rate[IMPULSE : IMPULSE + self._machines],
            machine_power=rate[WORK : WORK + self._machines],
            power_loss=float(rate[FRICTION] + rate[BEARING] + rate[CHURNING]),
            stored_power=stored,
            stored_energy=self._books[2],
            residual_power=_residual(rate, self._machines) - stored,
            course=self._follow(float(step)),
        )

    def _follow(self, duration: float) -> Course:
        """Counters of the last `duration` [s]."""
        self._settled += duration * self._settling
        missing, before = unsettled(self._settled, self._settling), self._course
        self._course = course_so_far(self._engine.control, missing)
        return self._course.since(before)

    def _angles(self) -> np.ndarray:
        """Angles modulo a turn [rad], computed from exact whole turns of the motors."""
        relative = np.append(self._end.angle[0], 0.0)[self._names.place]
        whole = self._whole_turns.parts(self._end.turns[0])
        return np.mod(2.0 * math.pi * whole + relative, 2.0 * math.pi)


def _residual(rate: np.ndarray, machines: int) -> float:
    """Input power minus dissipated power [W], from the rate of the ledger."""
    lost = rate[FRICTION] + rate[DAMPING] + rate[BEARING] + rate[CHURNING]
    return float(rate[WORK : WORK + machines].sum() + rate[STIFFNESS_WORK] - lost)


class _WholeTurns:
    """Turns of the bodies per whole turns of the motors, as integers.

    Args:
        bodies: ratios of the speed of each body to that of each motor.
    """

    def __init__(self, bodies: Sequence[Ratios]) -> None:
        common = [math.lcm(*(ratio.denominator for ratio in ratios)) for ratios in bodies]
        self._denominators = np.array(common, dtype=np.int64)
        self._numerators = np.array(
            [[int(r * n) for r in ratios] for ratios, n in zip(bodies, common, strict=True)],
            dtype=np.int64,
        )

    def parts(self, turns: np.ndarray) -> np.ndarray:
        """Fractions of a turn of the bodies, in [0, 1), from whole turns of the motors."""
        whole = turns[: self._numerators.shape[1]].astype(np.int64)
        parts = whole % self._denominators[:, None] * self._numerators  # no product overflows
        return np.asarray(parts.sum(axis=1) % self._denominators / self._denominators)


def _check_sample_rate(sample_rate: float) -> None:
    if not LOWEST_SAMPLE_RATE <= sample_rate <= 1e7:
        raise ValueError(f"sample_rate = {sample_rate!r} Hz: must be within 1 and 1e7")
