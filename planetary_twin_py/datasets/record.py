"""Simulates one record."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..checks.accuracy import accuracy_warnings
from ..checks.ledger import balance_of_run, ledger_warning
from ..recording.runs.offline import Plan, record_run
from ..run.commands import Commands
from ..run.readings import by_sensor
from ..run.result import Result
from ..scene import Scene
from ..sensors.sensed import Readings
from ..simulation.figures import figures_of_run
from ..simulation.simulate import selected, simulate
from ..studies.work import Failure
from .courses import commands_of
from .draws import Place, chance
from .plan import Record, sampled_of
from .spec import DatasetSpec

FILTERED = 0.05  # [s] more than a record, which the filters of most sensors need
LONGEST_FILTER = 60.0  # [s]
RATE = 1000.0  # [Hz] of the waveform, of which a recording has samples
BEGINS = 946_684_800 * 10**9  # [ns] ROS time of the start of every recording: the year 2000
WHOLE = 2**24  # up to here whole numbers have a single precision
ROUNDING = 1e-6  # periods by which a sample may seem early


class Signal(NamedTuple):
    """What a sensor with samples has recorded."""

    sensor: str
    kind: str
    unit: str
    rate: float
    """[Hz]"""
    samples: NDArray[np.float32]
    """(n,); of an encoder counts since the first sample."""
    clipped: int
    """Values beyond the range of the sensor, in the whole run."""


class Taken(NamedTuple):
    """A record."""

    signals: tuple[Signal, ...]
    """Of each sensor with samples, in the order of the scene."""
    pulses: NDArray[np.float64]
    """Of the tachometer: times of pulses since the start of the record [s], (pulses,)."""
    figures: dict[str, Any]
    """Of the run: speeds, its start and remarks."""
    recording: bytes | None
    """MCAP file of the run, if requested."""


class _Run(NamedTuple):
    """A run of a record."""

    result: Result
    sensors: Mapping[str, Readings]
    recording: bytes | None


@dataclass(frozen=True)
class Recorder:
    """Simulates records; it is pickled for other processes."""

    spec: DatasetSpec
    scene: Scene

    def __call__(self, record: Record) -> Taken | Failure:
        """Signals and figures of a record, or why there are none."""
        try:
            return self._taken(record)
        except (ValueError, ArithmeticError) as reason:
            return Failure(f"{record.name}: {reason}")

    def commands(self, record: Record, scene: Scene) -> Commands | None:
        """Commands at the ports of a record, whose scene is given; None if it is steady."""
        if record.course.steady:
            return None
        place = record.specimen, record.point, record.repetition
        random = chance(self.spec.seed, Place.COURSE, *place)
        begin = self.spec.settling
        return commands_of(scene, record.course, begin, begin + self.spec.duration, random)

    def _taken(self, record: Record) -> Taken:
        scene, _ = selected(self.scene.replace(**record.changes))
        run, longer = self._run(record, scene, FILTERED), FILTERED
        while not self._complete(run.sensors):
            longer *= 4.0
            if longer > LONGEST_FILTER:
                raise ValueError(f"sensors: their filters need more than {LONGEST_FILTER:g} s")
            run = self._run(record, scene, longer)
        begin = _start(run.sensors)
        end = begin + self.spec.duration
        pulses = [r.values[(begin <= r.values) & (r.values < end)] for r in _pulses(run.sensors)]
        figures = _figures(scene, run.result, self.spec.tolerance) | {"start": begin}
        rates = {sensor.name: sensor.rate for sensor in sampled_of(scene)}
        signals = tuple(self._signals(run.sensors, begin, rates))
        return Taken(signals, np.concatenate([*pulses, []]) - begin, figures, run.recording)

    def _run(self, record: Record, scene: Scene, longer: float) -> _Run:
        spec, commands = self.spec, self.commands(record, scene)
        duration = spec.duration + longer
        if not spec.mcap:
            result = simulate(
                scene, duration, RATE, tolerance=spec.tolerance, settling=spec.settling,
                commands=commands,
            )  # fmt: skip
            return _Run(result, result.sensors, None)
        plan = Plan(scene, duration, RATE, spec.tolerance, spec.settling, commands, BEGINS)
        parts = list[Readings]()
        with TemporaryDirectory() as folder:
            file, result = record_run(
                plan,
                Path(folder) / f"{record.name}.mcap",
                lambda time: None,
                lambda window: parts.extend(window.sensors.values()),
            )
            data = file.read_bytes()
        return _Run(result, by_sensor(parts, after=spec.settling), data)

    def _complete(self, sensors: Mapping[str, Readings]) -> bool:
        """Whether all sensors with samples have those of a record."""
        sampled = _sampled(sensors)
        if not all(len(reading.values) for reading in sampled):
            return False
        end = _start(sensors) + self.spec.duration
        return all(reading.time[-1] >= end for reading in sampled)

    def _signals(
        self, sensors: Mapping[str, Readings], begin: float, rates: Mapping[str, float]
    ) -> Iterator[Signal]:
        for reading in _sampled(sensors):
            first = math.ceil((begin - reading.first) / reading.period - ROUNDING)
            count = round(self.spec.duration / reading.period)
            values = reading.values[first : first + count]
            assert len(values) == count
            if np.issubdtype(values.dtype, np.integer):
                values = values - values[0]
                if np.abs(values).max() > WHOLE:
                    raise ValueError(
                        f"sensors: {reading.name}: {np.abs(values).max()} counts in a record: must "
                        f"be at most {WHOLE}, as samples have single precision"
                    )
            yield Signal(
                reading.name, reading.kind, reading.unit, rates[reading.name],
                values.astype(np.float32), reading.clipped,
            )  # fmt: skip


def _sampled(sensors: Mapping[str, Readings]) -> list[Readings]:
    """Sensors with samples at a rate."""
    return [reading for reading in sensors.values() if reading.period]


def _pulses(sensors: Mapping[str, Readings]) -> list[Readings]:
    """Tachometers."""
    return [reading for reading in sensors.values() if not reading.period]


def _start(sensors: Mapping[str, Readings]) -> float:
    """Time from which on all sensors have samples [s]."""
    return max(reading.first for reading in _sampled(sensors))


def _figures(scene: Scene, result: Result, tolerance: float) -> dict[str, Any]:
    """Mean speeds of a run, and its remarks."""
    ledger = ledger_warning(balance_of_run(result.energy), tolerance)
    remarks = [*([ledger] if ledger else []), *accuracy_warnings(scene, result)]
    bodies = dict(zip(result.bodies, result.mean_speed.tolist(), strict=True))
    return {
        "speed": bodies[scene.drive.input.member],
        "mesh_frequency": figures_of_run(scene, result, 0.0)["mesh_frequency"],
        "remarks": " ".join(remarks),
    }
