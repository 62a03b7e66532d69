"""A simulation that advances in windows and whose inputs can be changed between them."""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple

from ._core import Figures, WindowEnd, window_figures
from .accuracy import Course, Settling, course_so_far, unsettled
from .dynamics.bodies import body_names, build_report, mesh_names
from .gearset.kinematics import mesh_frequency
from .integrators.clock import TICKS
from .integrators.interpolant import Waves, new_waves
from .run import start
from .scene import TUNABLES, OperatingPoint, Scene, SceneError
from .tolerance import LIVE_TOLERANCE, check_tolerance
from .window import Waveform, Window, by_name
from .window_jobs import WindowJobs, run_alone

LEEWAY = 10**6  # of these parts of a sample period a sample may exceed the window by one
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
        self._teeth, self._sun = scene.gearset.tooth_numbers, self._names.names.index("sun")
        self._report = build_report(self._names, self._mesh_names)
        self._engine = start(scene, tolerance)
        self._figures = _FiguresOf(
            len(self.bodies), len(self.meshes), int(self._engine.train.machines)
        )
        self._ticks = 0
        self.log = [Change(0.0, scene.operating_point, tolerance, float(sample_rate))]
        """All changes. Applied at the same times, they reproduce the run and its samples."""
        self._ends = WindowEnd(), WindowEnd()  # of the last window, and of the next one
        self._stand()
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
        return self._ticks / TICKS

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
        plan = self._plan(duration)
        run_alone(self._jobs(plan))
        return self._close(plan)

    def _jobs(self, plan: _Plan) -> WindowJobs:
        """What the core is to compute for a window."""
        return self._engine.window(
            plan.end, plan.first, self.sample_rate, self._report, plan.waves, self._ends[1]
        )

    def _change(self, point: OperatingPoint, tolerance: float) -> float:
        change = Change(self.time, point, tolerance, self.sample_rate)
        if change[1:] != self.log[-1][1:]:
            self._engine.change(point, tolerance, Fraction(self._ticks, TICKS))
            self._stand()  # a change of backlash is not work of this window
            self._settling = self._forgetting.rate(point)
            self.log.append(change)
        return self.time

    def _stand(self) -> None:
        """Begin a window at the present time."""
        self._engine.stand(self._ticks, self._ends[0])

    def _plan(self, duration: float) -> _Plan:
        """Plan a window of `duration` seconds from the present time on."""
        longest = max(LONGEST_WINDOW, MOST_SAMPLES / self.sample_rate)
        if not 0.0 < duration <= longest:
            raise ValueError(f"duration = {duration!r} s: must be above 0 and at most {longest:g}")
        # Exact, so that rounding errors do not accumulate and windows of 10 ms end on samples.
        ticks = round(duration * TICKS)
        if not ticks:
            raise ValueError(f"duration = {duration!r} s: must be at least 1e-12, the clock's step")
        end = self._ticks + ticks
        first = self._samples(self._ticks) + 1
        waves = new_waves(self._samples(end) - first + 1, len(self.meshes))
        return _Plan(end, first, waves, self._engine.repeats)

    def _samples(self, ticks: int) -> int:
        """Number of samples up to a time."""
        over, under = self.sample_rate.as_integer_ratio()
        whole = TICKS * under  # in integers: fractions would be reduced at every step
        return (ticks * over * LEEWAY + whole) // (whole * LEEWAY)

    def _close(self, plan: _Plan) -> Window:
        """Results of the window that the engine has run through."""
        begin, end = self._ends
        figures, names, rate = self._figures, self._names, self.sample_rate
        start_time, duration = self.time, (plan.end - self._ticks) / TICKS
        window_figures(self._engine.train, self._report, begin, end, duration, figures.record)
        self._ticks, self._ends = plan.end, (end, begin)
        mean_speed, record = figures.mean_speed.copy(), figures.record
        sun, carrier = mean_speed[self._sun], mean_speed[-1]
        return Window(
            start=start_time,
            end=self.time,
            tolerance=self.tolerance,
            sample_rate=rate,
            repeated=plan.repeated,
            bodies=names.names,
            meshes=self.meshes,
            waveform=Waveform(1.0 / rate, *plan.waves),
            mesh=by_name(figures.statistics.copy()),
            angle=figures.angle.copy(),
            mean_speed=mean_speed,
            mesh_frequency=mesh_frequency(self._teeth, sun, carrier),
            machine_speed=figures.machine_speed.copy(),
            machine_torque=figures.machine_torque.copy(),
            machine_power=figures.machine_power.copy(),
            power_loss=record.power_loss,
            stored_power=record.stored_power,
            stored_energy=record.stored_energy,
            residual_power=record.residual_power,
            course=self._follow(duration),
        )

    def _follow(self, duration: float) -> Course:
        """Counters of the last `duration` [s]."""
        self._settled += duration * self._settling
        missing, before = unsettled(self._settled, self._settling), self._course
        self._course = course_so_far(self._engine.control, missing)
        return self._course.since(before)


class _Plan(NamedTuple):
    """A window to come."""

    end: int  # [ticks]
    first: int  # number of its first sample
    waves: Waves  # room for its samples
    repeated: bool


class _FiguresOf:
    """Figures of a window in the core, and views of them."""

    def __init__(self, bodies: int, meshes: int, machines: int) -> None:
        record = self.record = Figures()
        self.angle, self.mean_speed = record.angle[:bodies], record.mean_speed[:bodies]
        self.machine_speed = record.machine_speed[:machines]
        self.machine_torque = record.machine_torque[:machines]
        self.machine_power = record.machine_power[:machines]
        self.statistics = record.statistics[:, :meshes]


def _check_sample_rate(sample_rate: float) -> None:
    if not LOWEST_SAMPLE_RATE <= sample_rate <= 1e7:
        raise ValueError(f"sample_rate = {sample_rate!r} Hz: must be within 1 and 1e7")
