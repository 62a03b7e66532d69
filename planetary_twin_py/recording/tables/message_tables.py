"""Converts messages to tables of plain columns, in batches."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields
from typing import Any, NamedTuple

import numpy as np

from ...text.escaping import one_line
from ...units.catalogue import AXES_WAVEFORM as AXES_SAMPLES
from ...units.catalogue import COMPONENTS, MEMBERS
from ...units.catalogue import WAVEFORM as WAVEFORM_QUANTITIES
from ..container.records import RecordingError
from ..ros2.fields import ROOM
from ..ros2.message_units import units_of
from ..ros2.topics import AXES_STATE, AXES_WAVEFORM, GIVEN, JOINTS, POINT, STATE, WAVEFORM
from ..runs.schedule import stamp_of

Batch = dict[str, np.ndarray]
STAMP = "stamp"  # ROS time since the epoch [ns]; other columns are in SI
MESSAGES = 4096  # per batch, at most
ROWS = 2**17  # per batch, approximately
TABLES = (STATE, POINT, JOINTS, GIVEN, WAVEFORM, AXES_STATE, AXES_WAVEFORM)
"""Topics that can be exported."""
OF_JOINTS = {"position": "rad", "velocity": "rad/s", "effort": "N m"}
"""Units of the quantities of a joint, which the definition of JointState does not state."""
_LONGEST = 200  # characters of a list of joints


class Column(NamedTuple):
    """A column of a table."""

    name: str
    unit: str
    """Empty for columns without a unit, such as text."""
    kind: np.dtype[Any]


class Table:
    """Collects the messages of one topic in batches of columns.

    GearboxState, AxesState and OperatingPoint: one row per message; arrays have a column for each
    planet, `name_1`, `name_2`, .... JointState: one row per message, with a column for each
    quantity and joint, `effort_sun_joint`; missing values are NaN. MeshWaveform and AxesWaveform:
    one row per sample, with `time` and a column for each quantity and mesh, `dte_sun_planet_1`, or
    component of a body, `bearing_force_sun_x`.
    """

    def __init__(self, topic: str, definition: str) -> None:
        self._columns = _COLUMNS.get(topic, _rows)
        units = OF_JOINTS if topic in (JOINTS, GIVEN) else units_of(definition)
        self._units = {STAMP: "ns", "time": "s", **units}
        self._waiting: list[Any] = []
        self._planets: int | None = None
        self._joints: list[str] | None = None
        self._left_out = 0
        self._count = 0

    def add(self, message: Any) -> Iterator[Batch]:
        """Add a message; yields a batch when it is full.

        Raises:
            RecordingError: the number of planets changes.
        """
        planets, joints = getattr(message, "planets", None), getattr(message, "name", None)
        if self._planets not in (None, planets):
            raise RecordingError(
                f"planets = {planets}: was {self._planets} before; a table takes one gearbox only"
            )
        if self._joints not in (None, joints):  # another node publishes on the same topic
            self._left_out += 1
            return
        self._planets, self._joints = planets, joints
        self._waiting.append(message)
        self._count += getattr(message, "samples", 1)
        if self._count >= ROWS or len(self._waiting) >= MESSAGES:
            yield from self.rest()

    def rest(self) -> Iterator[Batch]:
        """The last, incomplete batch."""
        if self._waiting:
            yield self._columns(self._waiting)
        self._waiting, self._count = [], 0

    @property
    def remark(self) -> str:
        """Warning of messages that are not in the table, "" if there are none."""
        if not self._left_out:
            return ""
        joints = one_line(", ".join(self._joints or []), _LONGEST)
        return f"{self._left_out} messages are left out: their joints are others than {joints}"

    def describe(self, batch: Batch) -> list[Column]:
        """The columns of a batch with their units."""
        return [Column(name, self._unit(name), column.dtype) for name, column in batch.items()]

    def _unit(self, column: str) -> str:
        """Unit of the field whose name is the longest prefix of `column`."""
        if column in self._units:
            return self._units[column]
        parts = column.split("_")
        stems = ("_".join(parts[:n]) for n in range(len(parts) - 1, 0, -1))
        return next((self._units[stem] for stem in stems if stem in self._units), "")


def _rows(messages: list[Any]) -> Batch:
    """One row per message."""
    batch = {STAMP: _stamps(messages)}
    for name in _names(messages[0]):
        values = np.array([getattr(message, name) for message in messages])
        if values.ndim == 1:
            batch[name] = values
            continue
        for planet in range(messages[0].planets if values.shape[1] == ROOM else values.shape[1]):
            batch[f"{name}_{planet + 1}"] = values[:, planet]
    return batch


def _joint_rows(messages: list[Any]) -> Batch:
    """One row per message, a column for each field and joint; missing values are NaN."""
    joints = messages[0].name
    batch = {STAMP: _stamps(messages)}
    for name in OF_JOINTS:
        values = np.full((len(messages), len(joints)), np.nan)
        for row, message in zip(values, messages, strict=True):
            given = getattr(message, name)[: len(joints)]
            row[: len(given)] = given
        batch |= {f"{name}_{joint}": values[:, n] for n, joint in enumerate(joints)}
    return batch


def _waves(messages: list[Any]) -> Batch:
    """One row per sample, a column for each mesh."""
    planets = messages[0].planets
    meshes = [f"{kind}_{n + 1}" for kind in ("sun_planet", "planet_ring") for n in range(planets)]
    return _sampled(messages, dict.fromkeys(WAVEFORM_QUANTITIES, meshes))


def _axes_waves(messages: list[Any]) -> Batch:
    """One row per sample, a column for each component of a body."""
    planets = [f"planet_{n + 1}" for n in range(messages[0].planets)]
    names = {
        body: [f"{body}_{component}" for component in COMPONENTS[kind]]
        for kind, bodies in [*((m, [m]) for m in MEMBERS), ("planet", planets)]
        for body in bodies
    }
    of_members, of_all = (
        [name for body in bodies for name in names[body]] for bodies in (MEMBERS, names)
    )
    return _sampled(
        messages, {name: of_members if name == "orbit" else of_all for name in AXES_SAMPLES}
    )


def _sampled(messages: list[Any], series: dict[str, list[str]]) -> Batch:
    """One row per sample, with the columns of each quantity by their names."""
    counts = [message.samples for message in messages]
    offset = np.concatenate([np.arange(m.samples) * m.sample_period for m in messages])
    stamp = np.repeat(_stamps(messages), counts) + np.rint(offset * 1e9).astype(np.int64)
    start = np.repeat([message.start_time for message in messages], counts)
    batch = {STAMP: stamp, "time": start + offset}
    for name, columns in series.items():
        blocks = [getattr(message, name).reshape(len(columns), -1) for message in messages]
        samples = np.concatenate(blocks, axis=1)
        batch |= {f"{name}_{column}": samples[n] for n, column in enumerate(columns)}
    return batch


_COLUMNS = {
    WAVEFORM: _waves,
    AXES_WAVEFORM: _axes_waves,
    JOINTS: _joint_rows,
    GIVEN: _joint_rows,
}  # of other topics: _rows


def _names(message: Any) -> list[str]:
    return [f.name for f in fields(message) if f.name not in ("header", "__msgtype__")]


def _stamps(messages: list[Any]) -> np.ndarray:
    return np.array([stamp_of(message) for message in messages], dtype=np.int64)
