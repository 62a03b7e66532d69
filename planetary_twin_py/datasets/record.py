"""Simulates one record."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..checks.accuracy import accuracy_warnings
from ..checks.ledger import balance_of_run, ledger_warning
from ..run.commands import Commands
from ..run.result import Result
from ..scene import Scene
from ..sensors.accelerometer import measure_vibration
from ..simulation.figures import figures_of_run
from ..simulation.simulate import simulate
from ..studies.work import Failure
from .courses import commands_of
from .draws import Place, chance
from .plan import Record
from .spec import DatasetSpec

FILTERED = 0.1  # [s] more than a record, which the filters of the sensors need


class Signal(NamedTuple):
    """What one sensor has recorded."""

    sensor: str
    kind: str
    quantity: str
    unit: str
    rate: float
    """[Hz]"""
    samples: NDArray[np.float32]
    """(n,)"""
    clipped: int
    """Samples beyond the range of the sensor."""


class Taken(NamedTuple):
    """A record."""

    signals: tuple[Signal, ...]
    """Of each sensor with samples, in the order of the scene."""
    figures: dict[str, Any]
    """Of the run: speeds, torques and remarks."""


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
        spec, scene = self.spec, self.scene.replace(**record.changes)
        result = simulate(
            scene, spec.duration + FILTERED, 4.0 * scene.sensors[0].rate, tolerance=spec.tolerance,
            settling=spec.settling, commands=self.commands(record, scene),
        )  # fmt: skip
        signals = tuple(_signals(scene, result, spec.duration))
        return Taken(signals, _figures(scene, result, spec.tolerance))


def _signals(scene: Scene, result: Result, duration: float) -> Iterator[Signal]:
    for sensor in scene.sensors:
        heard = measure_vibration(scene, result, sensor)
        count = round(duration * sensor.rate)
        samples = heard.values[:count].astype(np.float32)
        assert len(samples) == count
        yield Signal(
            sensor.name,
            "accelerometer",
            "acceleration",
            "m/s^2",
            sensor.rate,
            samples,
            heard.clipped,
        )


def _figures(scene: Scene, result: Result, tolerance: float) -> dict[str, Any]:
    """Speeds, torque and remarks of a run."""
    ledger = ledger_warning(balance_of_run(result.energy), tolerance)
    remarks = [*([ledger] if ledger else []), *accuracy_warnings(scene, result)]
    bodies = dict(zip(result.bodies, result.mean_speed.tolist(), strict=True))
    return {
        "speed": bodies[scene.drive.input.member],
        "mesh_frequency": figures_of_run(scene, result, 0.0)["mesh_frequency"],
        "remarks": " ".join(remarks),
    }
