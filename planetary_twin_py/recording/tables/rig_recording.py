"""Writes measurements of a test rig as a recording."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import numpy as np
from rosbags.interfaces import Nodetype
from rosbags.typesys import get_types_from_msg

from ...model.clock import TICKS
from ...run.window_plan import LONGEST_WINDOW
from ...scene import TUNABLES, Scene
from ..ros2.bag import write_as
from ..ros2.definitions import topics_of
from ..ros2.fields import ROOM
from ..ros2.message_units import units_of
from ..ros2.metadata import Topic
from ..ros2.topics import DESCRIPTION, ORIGIN, POINT, STATE
from ..runs.compose import Composer, Row, new_bag
from ..runs.offline import NAMESPACE
from ..runs.origin import Measured, Origin
from ..runs.schedule import nanoseconds
from .measurements import Array, Measurements, naming, read_measurements
from .possible_losses import MEASURED, impossible_loss

TOPICS = (ORIGIN, DESCRIPTION, POINT, STATE)
PARTS = 4  # of an operating point, whose means are compared
DRIFT = 0.05  # allowed relative difference of these means


class SteadyRows(NamedTuple):
    """Rows at one operating point, from `first` to before `last`."""

    first: int
    last: int
    means: dict[str, float]
    """Means over these rows, of the fields of the operating point in the table."""
    scene: Scene
    """The scene at these means."""


class Imported(NamedTuple):
    """The new recording."""

    file: Path
    measured: Measurements
    points: list[SteadyRows]

    def lines(self, out: Path) -> Iterator[str]:
        """Number of rows, and the operating points with their start times.

        Args:
            out: what the recording is called.
        """
        step = self.measured.step
        yield f"{out}: {self.measured.rows} rows, one every {step:g} s"
        for part in self.points:
            means = (f"{name} = {v:.6g} {TUNABLES[name].unit}" for name, v in part.means.items())
            yield f"from {part.first * step:g} s: {', '.join(means) or 'as in the scene'}"


def write_measured(table: Path, scene: Scene, out: Path) -> Imported:
    """Convert a table of measurements to a recording.

    Simulated time starts one step before the time stamp of the first row.

    Args:
        table: CSV, Parquet or MAT file.
        scene: scene of the gearbox; gives the fields of the operating point that the table lacks.
        out: a bag folder, or a file that ends in .mcap.

    Raises:
        ValueError: a heading, a time stamp or a value is invalid, or a loss is negative or above
            the input power.
        FileExistsError: `out` exists.
        OSError: the table cannot be read, or the recording cannot be written.
    """
    topics = {topic.name.rpartition("/")[2]: topic for topic in topics_of(NAMESPACE)}
    places = _places(topics[STATE], scene.gearset.planets)
    shown = units_of(topics[STATE].definition)
    units = {name: tunable.unit for name, tunable in TUNABLES.items()}
    units |= {column: shown[field] for column, (field, _) in places.items()}
    measured = read_measurements(table, units)
    with naming(table):
        if measured.step > LONGEST_WINDOW:
            raise ValueError(
                f"a row every {measured.step:g} s: must be at most {LONGEST_WINDOW:g} s"
            )
        points = list(_points(measured, scene))

    def write(folder: Path) -> Path:
        with new_bag(folder, points[0].scene) as bag:
            composer = Composer(bag, [topics[name] for name in TOPICS], NAMESPACE)
            origin = Origin(points[0].scene, time.time_ns(), Measured(table.name))
            length, rows = round(measured.step * TICKS), _rows(measured, places)
            _compose(composer, origin, points, length, rows)
        return bag.file

    return Imported(write_as(out, write), measured, points)


def _compose(
    composer: Composer, origin: Origin, points: list[SteadyRows], length: int, rows: Iterator[Row]
) -> None:
    """Write intervals of `length` [ticks], with the measured fields `rows`."""
    composer.begin(origin)
    for part in points:
        begin = part.first * length
        stamp = origin.begins + nanoseconds(begin)
        composer.point(part.scene.live_values, begin / TICKS, stamp)
        for k in range(part.first, part.last):
            end = (k + 1) * length
            stamp = origin.begins + nanoseconds(end)
            times = {"simulated_time": end / TICKS, "interval": length / TICKS}
            planets = {"planets": part.scene.gearset.planets}
            composer.write(STATE, next(rows) | times | planets, stamp, stamp)


def _places(state: Topic, planets: int) -> dict[str, tuple[str, int | None]]:
    """Field of GearboxState and index of the planet (None for other fields), by column name."""
    places: dict[str, tuple[str, int | None]] = {}
    for field, (kind, _) in get_types_from_msg(state.definition, state.type)[state.type][1]:
        if kind == Nodetype.ARRAY:
            places |= {f"{field}_{n + 1}": (field, n) for n in range(planets)}
        elif field not in ("header", "sequence", "planets", "interval"):
            places[field] = field, None
    return places


def _rows(measured: Measurements, places: dict[str, tuple[str, int | None]]) -> Iterator[Row]:
    """Fields of GearboxState, row by row; NaN for missing values."""
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


def _points(measured: Measurements, scene: Scene) -> Iterator[SteadyRows]:
    """The operating points of a table: successive rows with the same label."""
    labels = measured.labels or [None] * measured.rows
    begins = [k for k in range(len(labels)) if not k or labels[k] != labels[k - 1]]
    columns = {
        name: column
        for name, column in measured.columns.items()
        if name in TUNABLES and not np.isnan(column).all()
    }
    for first, last in pairwise([*begins, len(labels)]):
        means = {name: _mean(name, column, first, last) for name, column in columns.items()}
        at_point = scene.replace(**means)
        rows = {n: measured.columns[n][first:last] for n in MEASURED if n in measured.columns}
        found = impossible_loss(rows, at_point)
        if found is not None:
            raise ValueError(f"row {first + found.row + 1}: {found.statement}")
        yield SteadyRows(first, last, means, at_point)


def _mean(name: str, column: Array, first: int, last: int) -> float:
    """Mean over the rows of one operating point; raises `ValueError` if the values drift."""
    values = column[first:last]
    if not np.isfinite(values).all():
        row = first + 1 + int(np.argmin(np.isfinite(values)))
        raise ValueError(f"row {row}: {name} = {column[row - 1]:g}: must be a number")
    mean = float(values.mean())
    parts = [part.mean() for part in np.array_split(values, min(PARTS, len(values)))]
    if max(parts) - min(parts) > DRIFT * abs(mean):
        raise ValueError(
            f"rows {first + 1} to {last}: {name} varies from {min(parts):.6g} to {max(parts):.6g} "
            f"{TUNABLES[name].unit}, must be constant within {DRIFT:.0%}; label the rows of each "
            f"operating point in a column operating_point, or remove the column {name} and use "
            "--set"
        )
    return mean
