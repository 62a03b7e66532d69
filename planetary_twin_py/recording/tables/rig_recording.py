"""What was measured on a rig, written as a recording of it."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import numpy as np
import yaml
from rosbags.interfaces import Nodetype
from rosbags.typesys import get_types_from_msg

from ...scene import TUNABLES, Scene
from ...twin import LONGEST_WINDOW, TICKS
from ..ros2.bag import BagWriter, write_as
from ..ros2.definitions import topics_of
from ..ros2.fields import ROOM
from ..ros2.message_units import units_of
from ..ros2.metadata import Topic
from ..ros2.topics import DESCRIPTION, ORIGIN, POINT, STATE
from ..runs.compose import Composer, Row
from ..runs.offline import NAMESPACE
from ..runs.origin import Measured, Origin
from ..runs.reader import SCENE_ATTACHMENT
from ..runs.schedule import nanoseconds
from .measurements import Array, Measurements, read_measurements

TOPICS = (ORIGIN, DESCRIPTION, POINT, STATE)
PARTS = 4  # of an operating point, whose means are compared
DRIFT = 0.05  # of its mean, by which they may differ


class Held(NamedTuple):
    """Rows at one operating point: those from `first` up to `last`, without it."""

    first: int
    last: int
    means: dict[str, float]
    """Over these rows, of what the table tells of the operating point."""
    scene: Scene
    """At these."""


class Imported(NamedTuple):
    """What was written."""

    file: Path
    measured: Measurements
    held: list[Held]


def write_measured(table: Path, scene: Scene, out: Path) -> Imported:
    """Write the measured `table` into `out`: a bag folder, or one file if it ends in .mcap.

    Simulated time begins a step before the time stamp of the first row. What the table does not
    tell of the operating point is as in `scene`.

    Raises:
        ValueError: a heading, a time stamp or a value cannot be.
        FileExistsError: `out` exists.
        OSError: the table cannot be read, or the recording not written.
    """
    topics = {topic.name.rpartition("/")[2]: topic for topic in topics_of(NAMESPACE)}
    places = _places(topics[STATE], scene.gearset.planets)
    shown = units_of(topics[STATE].definition)
    units = {name: tunable.unit for name, tunable in TUNABLES.items()}
    units |= {column: shown[field] for column, (field, _) in places.items()}
    measured = read_measurements(table, units)
    if measured.step > LONGEST_WINDOW:
        raise ValueError(f"a row every {measured.step:g} s: must be at most {LONGEST_WINDOW:g} s")
    held = list(_held(measured, scene))

    def write(folder: Path) -> Path:
        bag = BagWriter(folder)
        try:
            attached = yaml.safe_dump(held[0].scene.model_dump(mode="json"), sort_keys=False)
            bag.attach(SCENE_ATTACHMENT, attached.encode(), "application/yaml")
            composer = Composer(bag, [topics[name] for name in TOPICS], NAMESPACE)
            origin = Origin(held[0].scene, time.time_ns(), Measured(table.name))
            _compose(composer, origin, held, round(measured.step * TICKS), _rows(measured, places))
        finally:
            bag.close()
        return bag.file

    return Imported(write_as(out, write), measured, held)


def _compose(
    composer: Composer, origin: Origin, held: list[Held], length: int, rows: Iterator[Row]
) -> None:
    """Tell of intervals of `length` [ticks], of which `rows` show what was measured."""
    composer.begin(origin)
    for part in held:
        begin = part.first * length
        stamp = origin.begins + nanoseconds(begin)
        composer.point(part.scene.operating_point, begin / TICKS, stamp)
        for k in range(part.first, part.last):
            end = (k + 1) * length
            stamp = origin.begins + nanoseconds(end)
            told = {"simulated_time": end / TICKS, "interval": length / TICKS}
            planets = {"planets": part.scene.gearset.planets}
            composer.write(STATE, next(rows) | told | planets, stamp, stamp)


def _places(state: Topic, planets: int) -> dict[str, tuple[str, int | None]]:
    """Field of GearboxState that a column shows, and which planet's, from 0; None: no planet's."""
    places: dict[str, tuple[str, int | None]] = {}
    for field, (kind, _) in get_types_from_msg(state.definition, state.type)[state.type][1]:
        if kind == Nodetype.ARRAY:
            places |= {f"{field}_{n + 1}": (field, n) for n in range(planets)}
        elif field not in ("header", "sequence", "planets", "interval"):
            places[field] = field, None
    return places


def _rows(measured: Measurements, places: dict[str, tuple[str, int | None]]) -> Iterator[Row]:
    """Fields of GearboxState, row by row; NaN where nothing was measured."""
    shown = [(*places[name], column) for name, column in measured.columns.items() if name in places]
    for k in range(measured.rows):
        row: Row = {
            field: math.nan if planet is None else np.full(ROOM, math.nan)
            for field, planet in places.values()
        }
        for field, planet, column in shown:
            if planet is None:
                row[field] = float(column[k])
            else:
                row[field][planet] = column[k]
        yield row


def _held(measured: Measurements, scene: Scene) -> Iterator[Held]:
    """The operating points of a table: rows in sequence with the same label."""
    labels = measured.labels or [None] * measured.rows
    begins = [k for k in range(len(labels)) if not k or labels[k] != labels[k - 1]]
    columns = {
        name: column
        for name, column in measured.columns.items()
        if name in TUNABLES and not np.isnan(column).all()
    }
    for first, last in pairwise([*begins, len(labels)]):
        means = {name: _mean(name, column, first, last) for name, column in columns.items()}
        yield Held(first, last, means, scene.replace(**means))


def _mean(name: str, column: Array, first: int, last: int) -> float:
    """Over the rows of one operating point, which has to be one."""
    values = column[first:last]
    if not np.isfinite(values).all():
        row = first + 1 + int(np.argmin(np.isfinite(values)))
        raise ValueError(f"row {row}: {name} = {column[row - 1]:g}: must be a number")
    mean = float(values.mean())
    parts = [part.mean() for part in np.array_split(values, min(PARTS, len(values)))]
    if max(parts) - min(parts) > DRIFT * abs(mean):
        raise ValueError(
            f"rows {first + 1} to {last}: {name} goes from {min(parts):.6g} to {max(parts):.6g} "
            f"{TUNABLES[name].unit}, must stay within {DRIFT:.0%}: a column operating_point tells, "
            f"by any number or word, which rows belong together; or leave {name} out and set it"
        )
    return mean
