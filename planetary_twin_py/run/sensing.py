"""Feeds the sensors of a run with samples at their own rate, window by window."""

from __future__ import annotations

import math
from fractions import Fraction

from .._core import WITHIN_LIMITS, Report, Train
from ..model.clock import TICKS, Instant
from ..model.gearbox import Gearbox
from ..scene import OperatingPoint
from ..sensors.bank import SensorBank
from ..sensors.sensed import Readings, Sensed
from .readings import by_sensor
from .samples import SENSED, WaveRoom, Waves
from .warming import Warming
from .window_jobs import WindowJobs, grid
from .window_plan import Plan


class Sensing:
    """Sensors of a run, which see each part of a window as soon as it is computed.

    Their samples are taken beside those that are published, at a rate of their own. So readings
    depend neither on the sample rate of the waveform nor on the windows, and memory does not grow
    with the length of a window. After a time without samples the sensors restart.

    Args:
        gearbox: of the scene, which has sensors.
        train: of the run.
        report: number of the reported bodies and meshes.
        warming: temperatures of the run; None: those of the operating point.
        endless: whether the run is that of a twin, see `SensorBank`.
    """

    def __init__(
        self,
        gearbox: Gearbox,
        train: Train,
        report: Report,
        warming: Warming | None,
        endless: bool,
    ) -> None:
        self._gearbox, self._endless = gearbox, endless
        self._bank = SensorBank(gearbox, endless=endless)
        self._rate = Fraction(self._bank.rate)
        self._room = WaveRoom(train, report, SENSED)
        self._first = 1  # number of the next sample
        self._reached = 0  # [ticks] end of the last window with samples
        self._temperature = 0.0
        self._warming = warming
        self._found: list[Readings] = []

    def set_point(self, point: OperatingPoint) -> None:
        """Continue at an operating point."""
        self._temperature = point.oil_temperature

    def beside(self, jobs: WindowJobs, plan: Plan) -> WindowJobs:
        """Let the jobs of a window also take the samples of the sensors.

        Args:
            jobs: jobs of the core for the window.
            plan: the window.

        Yields:
            The jobs, and receives the outcome of each.
        """
        if plan.begin != self._reached:
            self._bank = SensorBank(self._gearbox, endless=self._endless)
            self._first = math.floor(Fraction(plan.begin, TICKS) * self._rate) + 1
        job = next(jobs, None)
        while job is not None:
            end = Fraction(plan.end, TICKS) if job.closes else _seconds(job.until)
            waves = self._room.new(self._due(end))
            own = grid(self._first, float(self._rate), waves)
            try:
                outcome = yield job._replace(grids=(*job.grids, own))
                if outcome == WITHIN_LIMITS:
                    self._feed(waves)
            except KeyboardInterrupt as interrupt:
                jobs.throw(interrupt)
            try:
                job = jobs.send(outcome)
            except StopIteration:
                job = None
        self._reached = plan.end

    def _due(self, until: Fraction) -> int:
        """Number of samples up to a time [s]; none is later, so that they add no step."""
        return max(math.floor(until * self._rate) + 1 - self._first, 0)

    def _feed(self, waves: Waves) -> None:
        bodies, axes = waves.bodies, waves.axes
        (mesh_force,) = waves.asked_of_meshes
        assert bodies is not None and waves.torque is not None
        displacement = None
        if axes is not None:
            rows, columns = axes.displacement.shape
            displacement = axes.displacement.reshape(rows, columns // 2, 2)
        self._found += self._bank.feed(
            Sensed(
                first=self._first,
                angle=bodies.angle,
                speed=bodies.speed,
                mesh_force=mesh_force,
                torque=waves.torque,
                displacement=displacement,
                oil_temperature=(self._temperature if self._warming is None else self._warming.oil),
            )
        )
        self._first += len(waves.time)

    def taken(self) -> dict[str, Readings]:
        """Readings that were completed since the last call, by name."""
        found, self._found = by_sensor(self._found), []
        return found

    def rest(self) -> dict[str, Readings]:
        """Readings from samples that wait for others, at the end of the run, by name."""
        return by_sensor(self._bank.end())


def _seconds(at: Instant) -> Fraction:
    return at.seconds + Fraction(at.time)
