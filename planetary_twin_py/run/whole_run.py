"""A run from its start to its result."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from .._core import WAVEFORM, Control
from ..gearset.kinematics import mesh_frequency
from ..model.clock import TICKS
from ..scene import Scene
from ..sensors.sensed import Readings
from ..units.catalogue import SAMPLED
from .axes.motion import axes_of_waves
from .axes.run_statistics import MOST_AT_ONCE, AxesSums, decimation
from .commanded_run import CommandedRun
from .commands import Commands
from .readings import by_sensor
from .result import Result, Stats
from .run_total import RunTotal
from .samples import EVERYTHING, Waves, joined_waves
from .steady_temperatures import with_start
from .window import Window
from .window_plan import Plan
from .windows import Windows

SPAN = TICKS // 100  # 10 ms, over which the power of a machine has one direction, that of its mean


class WholeRun:
    """A run of a scene, to be simulated once.

    Args:
        scene: to simulate; its dynamics are selected.
        tolerance: relative local error tolerance.
        method: see `run.engine.Engine`.
        commands: commands at the ports over time; None: none.

    Raises:
        ValueError: an argument is out of range, the scene is invalid, or a command is not given at
            its port.
    """

    def __init__(
        self,
        scene: Scene,
        tolerance: float,
        method: str = "auto",
        commands: Commands | None = None,
    ) -> None:
        scene = with_start(scene)
        self._scene, self._tolerance = scene, tolerance
        self._windows = Windows(scene, tolerance, method, EVERYTHING)
        self._course = CommandedRun(self._windows, scene, commands)
        self._wall = 0.0  # [s] that windows have taken

    @property
    def first_unused(self) -> float | None:
        """Time of the first command that does not act so far [s]; None if all do."""
        return self._course.first_unused

    def result(
        self,
        duration: float,
        sample_rate: float,
        settling: float = 0.0,
        watch: Callable[[Window], None] | None = None,
    ) -> Result:
        """Simulate.

        Args:
            duration: simulated time of the result [s].
            sample_rate: sample rate [Hz].
            settling: simulated time before the result [s].
            watch: called with each window of at most 10 ms, those of settling included; the result
                then has the samples of the last window alone, so memory does not grow with time.

        Returns:
            Samples, energy ledger and statistics of the time after `settling`.

        Raises:
            ValueError: a shaft cannot reach a position in time.
            RunawayError: the run exceeds physical limits.
        """
        scene, windows, watched = self._scene, self._windows, watch is not None
        begin, until = round(settling * TICKS), round((settling + duration) * TICKS)
        longest = SPAN if watched or self._course.commanded else None
        for plan in self._timed(begin, sample_rate, longest, watched):
            self._show(watch, plan)
        total, parts, rate, kept = RunTotal(windows), list[Waves](), sample_rate, 1
        readings = list[Readings]()
        axes = AxesSums(windows.run.gearbox) if scene.moving_axes else None
        if axes is not None:
            kept = decimation(scene, sample_rate)
            rate = kept * sample_rate
            most = int(MOST_AT_ONCE / rate * TICKS)
            longest = most if longest is None else min(most, longest)
        for plan in self._timed(until, rate, longest, True):
            total.add(windows.last, self._course.commanded)
            if axes is not None and plan.waves.bodies and plan.waves.axes:
                axes.add(plan.waves.bodies, plan.waves.axes)
            shown = plan if kept == 1 else _thinned(plan, kept, sample_rate)
            if watched:
                parts.clear()
                readings.clear()
            parts.append(shown.waves)
            readings += shown.sensors.values()
            self._show(watch, shown)
        if not watched:
            readings += windows.rest().values()
        total.close(duration)
        sensors = by_sensor(readings, after=begin / TICKS)
        result = self._result(total, joined_waves(parts), sensors, duration, until / TICKS)
        if axes is None or result.axes is None:
            return result
        return replace(result, axes=replace(result.axes, statistics=axes.statistics()))

    def _timed(self, until: int, rate: float, longest: int | None, sampled: bool) -> Iterator[Plan]:
        """Windows until `until` [ticks]; adds up the time that they take."""
        plans = self._course.advance(until, rate, longest, sampled)
        while True:
            begin = time.perf_counter()
            plan = next(plans, None)
            self._wall += time.perf_counter() - begin
            if plan is None:
                return
            yield plan

    def _show(self, watch: Callable[[Window], None] | None, plan: Plan) -> None:
        if watch is not None:
            watch(self._windows.results(plan, self._tolerance))

    def _result(
        self,
        total: RunTotal,
        waves: Waves,
        sensors: Mapping[str, Readings],
        duration: float,
        simulated: float,
    ) -> Result:
        scene, run = self._scene, self._windows.run
        names, mesh, mean_speed = run.gearbox.body_names.names, total.mesh, total.mean_speed
        sun, carrier = (float(mean_speed[names.index(body)]) for body in ("sun", "carrier"))
        frequency = mesh_frequency(scene.gearset.tooth_numbers, sun, carrier)
        assert waves.bodies is not None
        samples: dict[str, Any] = dict(zip(WAVEFORM, waves.asked_of_meshes, strict=True))
        return Result(
            duration=duration,
            time=waves.time,
            bodies=names,
            meshes=run.gearbox.mesh_names.names,
            angle=waves.bodies.angle,
            speed=waves.bodies.speed,
            mean_speed=mean_speed,
            **{name: samples[name] for name in (*SAMPLED, "mesh_power")},
            bearing_loss=waves.bodies.drag[:, 0],
            churning_loss=waves.bodies.drag[:, 1],
            energy=total.energy,
            mesh=mesh,
            mesh_efficiency=total.mesh_efficiency,
            axes=axes_of_waves(waves, scene.gearset.planets, mesh["mesh_force_mean"], frequency),
            stats=_stats(run.control, self._wall, simulated),
            start_warning=run.start_warning,
            damage=total.damage,
            temperatures={} if run.warming is None else run.warming.temperatures,
            heat={} if run.warming is None else total.heat,
            sensors=sensors,
        )


def _thinned(plan: Plan, kept: int, rate: float) -> Plan:
    """The window with one of `kept` samples, those at `rate` [Hz]."""
    begin = -plan.first % kept
    waves = plan.waves.select(lambda values: values[begin::kept].copy())
    first = (plan.first + begin) // kept
    waves = waves._replace(time=np.arange(first, first + len(waves.time)) / rate)
    return plan._replace(waves=waves, rate=rate, first=first)


def _stats(control: Control, wall: float, simulated: float) -> Stats:
    """Counters of a run that has simulated `simulated` seconds in `wall` seconds."""
    return Stats(
        steps=int(control.steps),
        repeated_steps=int(control.repeated),
        stiff_steps=int(control.stiff_steps),
        rejected_steps=int(control.rejected),
        evaluations=int(control.evaluations),
        pair_events=int(control.pair_events),
        flank_events=int(control.flank_events),
        reversals=int(control.reversals),
        both_flanks=int(control.both_flanks),
        wall_time=wall,
        real_time_factor=simulated / wall,
    )
