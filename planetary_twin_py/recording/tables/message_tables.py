"""Converts messages to tables of plain columns, in batches."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from ...text.escaping import one_line
from ...units.catalogue import AXES_WAVEFORM as AXES_SAMPLES
from ...units.catalogue import COMPONENTS, MEMBERS
from ...units.catalogue import WAVEFORM as WAVEFORM_QUANTITIES
from ..container.records import RecordingError
from ..ros2.fields import ROOM
from ..ros2.message_units import units_of
from ..ros2.sensor_topics import ENCODERS, OF_LEVELS, OF_THERMAL, PULSES, TEMPERATURE
from ..ros2.topics import (
    AXES_STATE,
    AXES_WAVEFORM,
    DAMAGE,
    DAMAGE_TEETH,
    GIVEN,
    JOINTS,
    POINT,
    STATE,
    WAVEFORM,
)
from ..runs.series import column
from ..runs.waveform import stamps

Batch = dict[str, np.ndarray]
Rows = np.ndarray
"""Messages with the same layout, as a structured array."""
STAMP = "stamp"  # ROS time since the epoch [ns]; other columns are in SI
TABLES = (
    STATE, POINT, JOINTS, GIVEN, WAVEFORM, AXES_STATE, AXES_WAVEFORM, DAMAGE, DAMAGE_TEETH,
)  # fmt: skip
"""Topics of a twin that can be exported, beside sensors."""
OF_SENSORS = (ENCODERS, PULSES, TEMPERATURE, OF_LEVELS, OF_THERMAL)
"""Types of the messages of sensors with a row per message, count or pulse."""
OF_JOINTS = {"position": "rad", "velocity": "rad/s", "effort": "N m"}
"""Units of the quantities of a joint, which the definition of JointState does not state."""
CELSIUS = {"temperature": "degC", "variance": "K^2"}
"""Units of Temperature, by its definition in words."""
_LONGEST = 200  # characters of a list of joints


class Column(NamedTuple):
    """A column of a table."""

    name: str
    unit: str
    """Empty for columns without a unit, such as text."""
    kind: np.dtype[Any]


class Table:
    """Converts the messages of one topic to columns.

    GearboxState, AxesState and OperatingPoint: one row per message; arrays have a column for each
    planet, `name_1`, `name_2`, .... JointState: one row per message, with a column for each
    quantity and joint, `effort_sun_joint`; missing values are NaN. MeshWaveform and AxesWaveform:
    one row per sample, with `time` and a column for each quantity and mesh, `dte_sun_planet_1`, or
    component of a body, `bearing_force_sun_x`. DamageState and DamageTeeth: one row per message,
    with a column for each quantity and part, `damage_sun_root`, or tooth. EncoderBlock: one row
    per count; PulseTimes: one per pulse.
    """

    def __init__(self, topic: str, kind: str, definition: str) -> None:
        self._columns = _COLUMNS.get(topic) or _OF_TYPES.get(kind, _rows)
        units = OF_JOINTS if topic in (JOINTS, GIVEN) else units_of(definition)
        units |= CELSIUS if kind == TEMPERATURE else {}
        self._units = {STAMP: "ns", "time": "s", **units}
        self._planets: int | None = None
        self._joints: tuple[bytes, ...] | None = None
        self._left_out = 0

    def batch(self, parts: list[Rows]) -> Batch:
        """The columns of successive messages, in parts with the same layout; {} if none has rows.

        Raises:
            RecordingError: the number of planets changes, or a field has no column.
        """
        if self._columns is _joint_rows:
            parts = [rows for rows in map(self._of_same_joints, parts) if len(rows)]
        if not parts:
            return {}
        for rows in parts if "planets" in (parts[0].dtype.names or ()) else ():
            for planets in np.unique(rows["planets"]).tolist():
                if self._planets not in (None, planets):
                    raise RecordingError(
                        f"planets = {planets}: was {self._planets} before; a table takes one "
                        "gearbox only"
                    )
                self._planets = planets
        return self._columns(parts)

    def _of_same_joints(self, rows: Rows) -> Rows:
        """The messages of the joints of the first one; another node may publish on the topic."""
        names = rows["name"].tolist()
        self._joints = names[0] if self._joints is None else self._joints
        same = np.array([each == self._joints for each in names])
        self._left_out += int(np.count_nonzero(~same))
        return rows[same]

    @property
    def remark(self) -> str:
        """Warning of messages that are not in the table, "" if there are none."""
        if not self._left_out:
            return ""
        joints = one_line(", ".join(_texts(self._joints or ())), _LONGEST)
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


def _rows(parts: list[Rows]) -> Batch:
    """One row per message."""
    batch = {STAMP: _stamps(parts)}
    for name in parts[0].dtype.names or ():
        if name == "header":
            continue
        values = column(name, [rows[name] for rows in parts])
        if values.dtype.names is not None:
            raise RecordingError(f"field {name} of a message: a table has no column for its type")
        if values.dtype.kind in "iu":  # without sign, a difference of two could not be negative
            values = values.astype(np.int64)
        if values.ndim == 1:
            batch[name] = values
            continue
        planets = int(parts[0]["planets"][0]) if values.shape[1] == ROOM else values.shape[1]
        batch |= {f"{name}_{planet + 1}": values[:, planet] for planet in range(planets)}
    return batch


def _joint_rows(parts: list[Rows]) -> Batch:
    """One row per message, a column for each field and joint; missing values are NaN."""
    joints = _texts(parts[0]["name"][0].item())
    batch = {STAMP: _stamps(parts)}
    for name in OF_JOINTS:
        filled = []
        for rows in parts:
            given = rows[name][:, : len(joints)]
            filled.append(np.full((len(rows), len(joints)), np.nan))
            filled[-1][:, : given.shape[1]] = given
        values = np.concatenate(filled)
        batch |= {f"{name}_{joint}": values[:, n] for n, joint in enumerate(joints)}
    return batch


def _damage_rows(parts: list[Rows]) -> Batch:
    """One row per message, a column for each quantity and part of a gearbox."""
    names = _texts(parts[0]["parts"][0].item())
    plain = ("sequence", "simulated_time", "hours", "unknown_hours", "outside_hours", "worst")
    batch = {STAMP: _stamps(parts)} | {n: column(n, [rows[n] for rows in parts]) for n in plain}
    for name in ("damage", "rate", "mean_rate", "remaining_hours", "passages"):
        values = column(name, [rows[name] for rows in parts])
        batch |= {f"{name}_{part}": values[:, n] for n, part in enumerate(names)}
    return batch | {"sequence": batch["sequence"].astype(np.int64)}


def _damage_teeth(parts: list[Rows]) -> Batch:
    """One row per message, a column for each tooth of a part, counted from 0."""
    names, teeth = _texts(parts[0]["parts"][0].item()), parts[0]["teeth"][0]
    batch = {n: column(n, [rows[n] for rows in parts]) for n in ("sequence", "simulated_time")}
    values = column("damage", [rows["damage"] for rows in parts])
    each = [f"damage_{part}_{n}" for part, count in zip(names, teeth, strict=True)
            for n in range(count)]  # fmt: skip
    batch["sequence"] = batch["sequence"].astype(np.int64)
    return {STAMP: _stamps(parts)} | batch | {name: values[:, n] for n, name in enumerate(each)}


def _texts(names: Sequence[bytes]) -> list[str]:
    return [str(name) for name in column("name", [np.array(names, dtype="S")])]


def _waves(parts: list[Rows]) -> Batch:
    """One row per sample, a column for each mesh."""
    planets = int(parts[0]["planets"][0])
    meshes = [f"{kind}_{n + 1}" for kind in ("sun_planet", "planet_ring") for n in range(planets)]
    return _sampled(parts, dict.fromkeys(WAVEFORM_QUANTITIES, meshes))


def _axes_waves(parts: list[Rows]) -> Batch:
    """One row per sample, a column for each component of a body."""
    planets = [f"planet_{n + 1}" for n in range(int(parts[0]["planets"][0]))]
    names = {
        body: [f"{body}_{component}" for component in COMPONENTS[kind]]
        for kind, bodies in [*((m, [m]) for m in MEMBERS), ("planet", planets)]
        for body in bodies
    }
    of_members, of_all = (
        [name for body in bodies for name in names[body]] for bodies in (MEMBERS, names)
    )
    return _sampled(
        parts, {name: of_members if name == "orbit" else of_all for name in AXES_SAMPLES}
    )


def _sampled(parts: list[Rows], series: dict[str, list[str]]) -> Batch:
    """One row per sample, with the columns of each quantity by their names."""
    found: list[Batch] = []
    for rows in parts:
        samples = int(rows["samples"][0])
        offset = np.arange(samples) * rows["sample_period"][:, None]
        stamp = stamps(rows)[:, None] + np.rint(offset * 1e9).astype(np.int64)
        batch = {STAMP: stamp, "time": rows["start_time"][:, None] + offset}
        for name, columns in series.items():
            if (rows["samples"] * len(columns) != rows[name].shape[1]).any():
                raise RecordingError(f"{name}: its length must be {len(columns)} x samples")
            values = rows[name].reshape(len(rows), len(columns), samples)
            batch |= {f"{name}_{mesh}": values[:, n] for n, mesh in enumerate(columns)}
        found.append(batch)
    return {name: column(name, [batch[name].reshape(-1) for batch in found]) for name in found[0]}


def _counts(parts: list[Rows]) -> Batch:
    """One row per count of an encoder; a missing encoder has no column."""
    batches: list[Batch] = []
    for rows in parts:
        given = [n for n in ("input_counts", "output_counts") if rows[n].shape[1]]
        number = np.arange(max((rows[n].shape[1] for n in given), default=0))
        offset = np.rint(1e9 * number * rows["sample_period"][:, None]).astype(np.int64)
        batches.append(
            {
                STAMP: (stamps(rows)[:, None] + offset).ravel(),
                "sample": (rows["first_sample"][:, None] + number).ravel(),
                **{name: rows[name].ravel() for name in given},
            }
        )
    return _concatenated(batches)


def _pulses(parts: list[Rows]) -> Batch:
    """One row per pulse."""
    batches = []
    for rows in parts:
        offset = np.rint(1e9 * (rows["times"] - rows["times"][:, :1])).astype(np.int64)
        stamp = stamps(rows)[:, None] + offset
        batches.append({STAMP: stamp.ravel(), "time": rows["times"].ravel()})
    return _concatenated(batches)


def _concatenated(batches: list[Batch]) -> Batch:
    """Successive batches as one.

    Raises:
        RecordingError: they have different columns.
    """
    names = [*batches[0]]
    if any([*batch] != names for batch in batches):
        raise RecordingError("an encoder is missing in some blocks: a table has one format only")
    return {name: column(name, [batch[name] for batch in batches]) for name in names}


_OF_TYPES = {ENCODERS: _counts, PULSES: _pulses}
_COLUMNS = {
    WAVEFORM: _waves,
    AXES_WAVEFORM: _axes_waves,
    JOINTS: _joint_rows,
    GIVEN: _joint_rows,
    DAMAGE: _damage_rows,
    DAMAGE_TEETH: _damage_teeth,
}  # of other topics: _rows


def _stamps(parts: list[Rows]) -> np.ndarray:
    return np.concatenate([stamps(rows) for rows in parts])
