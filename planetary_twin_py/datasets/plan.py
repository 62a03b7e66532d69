"""All records of a data set, with everything that is drawn for them."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

from pydantic import ValidationError

from ..scene import TUNABLES, Scene, SceneError
from ..scene.defect import explain
from ..scene.names import no_such_field
from ..scene.sensors import (
    Accelerometer,
    Encoder,
    Proximity,
    Tachometer,
    Thermometer,
    Torque,
)
from ..simulation.simulate import MOST_SAMPLES
from ..studies.axes import Axis, Normal, Span, planet_by_planet
from .draws import Place, chance, read_draw, value_at
from .spec import Course, DatasetSpec
from .splits import splits_of
from .states import LEVELS, State, read_states

SEEDS = 1_000_000_000  # of sensors, whose names make their noise differ, too
WANDERING = {  # what speed and torque that change within a record require of the drive
    "drive.input.port": "motion",
    "drive.output.port": "torque",
    "drive.interpolation": "linear",
}


class Record(NamedTuple):
    """One run of one specimen."""

    specimen: int
    state: int
    point: int
    repetition: int
    run: int
    """Number among the runs of the specimen."""
    split: str
    """Part of the data set."""
    drawn: dict[str, Any]
    """What is drawn for the specimen, by dotted name, in SI."""
    changes: dict[str, Any]
    """All that differs from the scene of the data set, by dotted name."""
    course: Course
    """How speed and torque change."""
    severity: float
    """Severity in SI; 0 if healthy, NaN if none is drawn."""
    level: int
    """Severity from 1 to `LEVELS` among those of its state; 0 if healthy."""

    @property
    def name(self) -> str:
        """Of the run, unique in the data set."""
        return f"{self.specimen_name}_run{self.run:04d}"

    @property
    def specimen_name(self) -> str:
        """Of the specimen."""
        return f"specimen{self.specimen:05d}"

    @property
    def pair(self) -> str:
        """The same for the records that differ in their faults and their noise alone."""
        return f"{self.specimen_name}_point{self.point:03d}_repetition{self.repetition:04d}"


class _Faulty(NamedTuple):
    """Faults of a specimen in one state, and their severity."""

    faults: list[dict[str, Any]]
    severity: float
    level: int


@dataclass(frozen=True)
class DatasetPlan:
    """The records of a specification.

    Raises:
        SceneError: a field does not exist, or a value is out of range.
    """

    spec: DatasetSpec
    base: Scene
    """Scene of the specification."""
    scene: Scene = field(init=False)
    """Of all specimens: lists with a value for each planet have them, if they are drawn."""
    states: tuple[State, ...] = field(init=False)
    drawn: tuple[Axis | Span | Normal, ...] = field(init=False)
    """Distributions of the specimens."""
    points: tuple[tuple[tuple[Axis | Span | Normal, ...], Course], ...] = field(init=False)
    """Distributions and course of each operating point."""
    splits: tuple[str, ...] = field(init=False)
    """Part of each specimen."""
    counts: dict[str, int] = field(init=False)
    """Number of samples in a record, by the sensors that have samples."""

    def __post_init__(self) -> None:
        scene, drawn = self.base, list[Axis | Span | Normal]()
        for name, given in self.spec.drawn.items():
            scene, entries = planet_by_planet(scene, name, str(given))
            drawn += [_named(f"drawn.{entry}", scene, entry, given) for entry in entries]
        for name, value in (
            ("scene", scene),
            ("drawn", tuple(drawn)),
            ("states", read_states(scene, self.spec.faults)),
            (
                "points",
                tuple(_point(scene, n, p) for n, p in enumerate(self.spec.points)),
            ),
            ("splits", tuple(splits_of(self.spec))),
            ("counts", _counts(scene, self.spec.duration)),
        ):
            object.__setattr__(self, name, value)

    @cached_property
    def labels(self) -> list[str]:
        """Labels of the states, each once."""
        return list(dict.fromkeys(state.label for state in self.states))

    def records(self) -> Iterator[Record]:
        """All records, in order of specimens and of their runs, whose states are in a drawn order.

        Raises:
            SceneError: the scene does not accept what is drawn.
        """
        for specimen in range(self.spec.specimens):
            yield from sorted(self._specimen(specimen), key=lambda record: record.run)

    def _specimen(self, specimen: int) -> Iterator[Record]:
        where = f"specimen {specimen}"
        drawn = self._values(self.drawn, Place.SPECIMEN, specimen)
        scene = _replaced(where, self.scene, drawn)
        split = self.splits[specimen]
        # Drawn, as otherwise name, place and seed of a record would say which state it is in.
        count = self.spec.records_per_specimen
        runs = iter(chance(self.spec.seed, Place.RUN, specimen).permutation(count).tolist())
        for number, state in enumerate(self.states):
            faulty = self._faults(scene, specimen, number, state)
            for point, (draws, course) in enumerate(self.points):
                for repetition in range(self.spec.repetitions):
                    at = self._values(draws, Place.POINT, specimen, point, repetition)
                    _checked_point(where, scene, at)
                    ports, run = {} if course.steady else WANDERING, next(runs)
                    changes = drawn | {"faults": faulty.faults} | at | ports
                    yield Record(
                        specimen, number, point, repetition, run, split, drawn,
                        changes | self._seeds(specimen, run), course, faulty.severity, faulty.level,
                    )  # fmt: skip

    def _values(
        self, draws: tuple[Axis | Span | Normal, ...], place: Place, *numbers: int
    ) -> dict[str, Any]:
        """Values of distributions, by field."""
        return {
            draw.field: value_at(draw, self._share(place, *numbers, name=draw.field))
            for draw in draws
        }

    def _faults(self, scene: Scene, specimen: int, number: int, state: State) -> _Faulty:
        if not state.faults:
            return _Faulty([], 0.0, 0)
        names = [f"faults.{n}.{name}" for n, name, _ in state.draws]
        shares = {name: self._share(Place.STATE, specimen, number, name=name) for name in names}
        faults, named = state.drawn(shares), state.severity
        found = _replaced(f"specimen {specimen}, {state.label}", scene, {"faults": faults})
        if named is None:
            return _Faulty(faults, math.nan, 1)
        _, place, name = named.split(".")
        value = float(getattr(found.faults[int(place)], name))
        return _Faulty(faults, value, 1 + int(LEVELS * shares[named]))

    def _share(self, place: Place, *numbers: int, name: str) -> float:
        return float(chance(self.spec.seed, place, *numbers, name=name).random())

    def _seeds(self, specimen: int, run: int) -> dict[str, int]:
        """Seed of the sensors of a run, by dotted name: another one for each run."""
        first = int(chance(self.spec.seed, Place.SENSOR).integers(SEEDS))
        seed = (first + specimen * self.spec.records_per_specimen + run) % SEEDS
        return {f"sensors.{number}.seed": seed for number in range(len(self.scene.sensors))}


def _named(place: str, scene: Scene, name: str, given: Any) -> Axis | Span | Normal:
    """A distribution; errors name its place in the specification."""
    try:
        return read_draw(scene, name, given)
    except ValueError as error:
        text = re.sub(rf"^{re.escape(name)}\b", place, str(error))
        raise SceneError(text if text.startswith(place) else f"{place}: {text}") from None


def _replaced(where: str, scene: Scene, changes: dict[str, Any]) -> Scene:
    try:
        return scene.replace(**changes)
    except SceneError as error:
        raise SceneError(f"{where}: {error}") from None


def _checked_point(where: str, scene: Scene, values: dict[str, Any]) -> None:
    try:
        scene.point_with(scene.operating_point, values)
    except SceneError as error:
        raise SceneError(f"{where}: {error}") from None


def _point(
    scene: Scene, number: int, given: dict[str, Any]
) -> tuple[tuple[Axis | Span | Normal, ...], Course]:
    place, draws, course = f"operating_points.{number}", [], {}
    for name, value in given.items():
        if name in TUNABLES:
            draws.append(_named(f"{place}.{name}", scene, name, value))
        elif name in Course.model_fields:
            course[name] = value
        else:
            known = (*TUNABLES, *Course.model_fields)
            raise SceneError(f"{place}.{no_such_field(name, known)}")
    try:
        return tuple(draws), Course.model_validate(course)
    except ValidationError as error:
        raise SceneError(f"{place}.{explain(error, Course)}") from None


def sampled_of(scene: Scene) -> list[Accelerometer | Encoder | Torque | Proximity | Thermometer]:
    """Sensors of a scene that have samples at a rate."""
    return [sensor for sensor in scene.sensors if not isinstance(sensor, Tachometer)]


def _counts(scene: Scene, duration: float) -> dict[str, int]:
    """Number of samples of each sensor with a rate in a time [s]."""
    sampled = sampled_of(scene)
    if not sampled:
        raise SceneError(
            "sensors: none with samples; give the scene an accelerometer, e.g. "
            "set: {sensors: [{name: ring, kind: accelerometer}]}"
        )
    if len(scene.sensors) - len(sampled) > 1:
        raise SceneError("sensors: must have at most one tachometer, whose pulses go with each row")
    counts = {sensor.name: round(duration * sensor.rate) for sensor in sampled}
    for name, count in counts.items():
        if not 1 <= count <= MOST_SAMPLES:
            raise SceneError(
                f"duration = {duration:g} s: gives {count} samples of sensor {name}: must be "
                f"within 1 and {MOST_SAMPLES}"
            )
    return counts
