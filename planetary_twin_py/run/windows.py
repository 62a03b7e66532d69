"""Consecutive windows of a run."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from .._core import Report, WindowEnd
from ..model.clock import TICKS
from ..scene import OperatingPoint, Scene
from ..sensors.sensed import Readings
from .counters import Course, Settling, course_so_far, unsettled
from .interface import Run
from .samples import PUBLISHED_ONES, Asked, WaveRoom
from .start import start
from .window import Window
from .window_jobs import WindowJobs
from .window_plan import Plan, samples_until
from .window_results import WindowResults

if TYPE_CHECKING:
    from .sensing import Sensing


class Windows:
    """A run that advances from window to window.

    Args:
        scene: to simulate.
        tolerance: relative local error tolerance.
        method: see `run.engine.Engine`.
        asked: quantities of the samples.

    Raises:
        ValueError: an argument is out of range, or the scene cannot be built.
    """

    def __init__(
        self, scene: Scene, tolerance: float, method: str = "auto", asked: Asked = PUBLISHED_ONES
    ) -> None:
        self.run: Run = start(scene, tolerance, method)
        """The model in progress."""
        gearbox = self.run.gearbox
        self.report = gearbox.report
        """Indices of the reported bodies and meshes."""
        self.ticks = 0
        """Present time [ticks of the clock]: the end of the last window."""
        self._room = WaveRoom(self.run.train, self.report, asked)
        sensed = asked.sensors and bool(scene.sensors)
        endless = asked == PUBLISHED_ONES
        self._sensing = _sensing(self.run, self.report, endless) if sensed else None
        self._results, core = WindowResults(gearbox), gearbox.core
        self._ends = core.WindowEnd(), core.WindowEnd()  # of the last window, and of the next one
        self.begin()
        self._settling_rates, self._settled = Settling(gearbox), 0.0
        self.set_point(scene.operating_point)
        self._course = course_so_far(self.run.control, 0.0)

    def begin(self) -> None:
        """Begin a window at the present time, after a change."""
        self.run.begin_window(self.ticks, self._ends[0])

    def set_point(self, point: OperatingPoint) -> None:
        """Continue at `point`; friction of creeping gears settles as fast as there."""
        self._results.point = point
        self._settling = self._settling_rates.rate(point)
        if self._sensing is not None:
            self._sensing.set_point(point)

    def plan(self, end: int, rate: float, sampled: bool = True) -> Plan:
        """Plan a window from the present time on.

        Args:
            end: its end [ticks].
            rate: sample rate [Hz].
            sampled: whether it has samples.
        """
        first = samples_until(self.ticks, rate) + 1
        rows = samples_until(end, rate) - first + 1 if sampled else 0
        return Plan(self.ticks, end, rate, first, self._room.new(rows), self.run.repeats)

    def jobs(self, plan: Plan) -> WindowJobs:
        """Jobs of the core for a window."""
        jobs = self.run.window(
            plan.end, plan.first, plan.rate, self.report, plan.waves, self._ends[1]
        )
        return jobs if self._sensing is None else self._sensing.beside(jobs, plan)

    def close(self, plan: Plan) -> Plan:
        """End the window whose jobs are done; the plan then has the readings of the sensors."""
        self.ticks, self._ends = plan.end, self._ends[::-1]
        return plan if self._sensing is None else plan._replace(sensors=self._sensing.taken())

    def rest(self) -> Mapping[str, Readings]:
        """Readings of the sensors that no window has completed, at the end of the run."""
        return {} if self._sensing is None else self._sensing.rest()

    @property
    def last(self) -> WindowEnd:
        """End of the last window."""
        return self._ends[0]

    def results(self, plan: Plan, tolerance: float) -> Window:
        """Results of the window that was closed last.

        Args:
            plan: the window.
            tolerance: relative local error tolerance.

        Returns:
            Statistics and waveform.
        """
        end, begin = self._ends
        self._results.evaluate(begin, end, plan)
        course = self._follow((plan.end - plan.begin) / TICKS)
        if plan.begin == 0:
            course = course._replace(start_warning=self.run.start_warning)
        return self._results.window(plan, tolerance, course, self.run)

    def _follow(self, duration: float) -> Course:
        """Counters of the last `duration` [s]."""
        self._settled += duration * self._settling
        missing, before = unsettled(self._settled, self._settling), self._course
        self._course = course_so_far(self.run.control, missing)
        return self._course.since(before)


def _sensing(run: Run, report: Report, endless: bool) -> Sensing:
    """Sensors of a run, whose filters take time to load."""
    from .sensing import Sensing

    return Sensing(run.gearbox, run.train, report, run.warming, endless)
