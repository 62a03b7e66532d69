"""Messages of one topic as columns."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..container.records import RecordingError
from ..ros2.definitions import KINDS
from ..ros2.topics import STATE
from ..ros2.typestore import absent
from .waveform import stamps


@dataclass
class Series:
    """Messages of one topic as columns: `series[name]` has one row per message.

    `time` is the simulated time [s], `stamp` the corresponding ROS time [ns since the epoch].
    """

    time: NDArray[np.float64]
    stamp: NDArray[np.int64]
    columns: dict[str, Any]

    def __getitem__(self, name: str) -> Any:
        return self.columns[name]

    def __len__(self) -> int:
        return len(self.time)


def planets_in(state: Series, path: Path, namespace: str) -> int:
    """Number of planets in the states of a gearbox.

    Args:
        state: at least one state.
        path: path of the recording, for error messages.
        namespace: namespace of the gearbox.

    Raises:
        RecordingError: the number is invalid or changes.
    """
    planets, room = np.unique(state["planets"]), state["planet_angle"].shape[1]
    if len(planets) != 1 or not 1 <= planets[0] <= room:
        listed = ", ".join(map(str, planets[:3]))
        raise RecordingError(
            f"{path}: {namespace}/{STATE}: planets = {listed}: must be one number in all messages, "
            f"within 1 and {room}"
        )
    return int(planets[0])


def series_of(topic: str, parts: list[NDArray[Any]]) -> Series:
    """Make columns of the messages of a topic; fields that some messages lack are `absent` there.

    Args:
        topic: one of `SERIES`.
        parts: structured arrays of messages; the list is emptied, so that each is freed when it is
            copied.

    Returns:
        The columns, without rows if there are no parts.

    Raises:
        RecordingError: the shapes of a field differ, or a text is not UTF-8.
    """
    if not parts:
        return Series(np.empty(0), np.empty(0, np.int64), {})
    empty = absent(KINDS[topic], ())
    everywhere = set.intersection(*(set(rows.dtype.names or ()) for rows in parts))
    names = [
        name
        for name in dict.fromkeys([*(parts[0].dtype.names or ()), *empty])
        if name != "header" and (name in everywhere or name in empty)
    ]
    layouts = list({rows.dtype: rows[:0] for rows in parts}.values())
    end = sum(map(len, parts))
    stamp, values = np.empty(end, np.int64), dict[str, NDArray[Any]]()
    for name in names:
        samples = [_values(rows, name, empty) for rows in layouts]
        column(name, samples)  # raises an error if their shapes differ
        values[name] = np.empty((end, *samples[0].shape[1:]), np.result_type(*samples))
    while parts:  # from the last one, so that the allocator can return the memory
        rows = parts.pop()
        into, end = slice(end - len(rows), end), end - len(rows)
        stamp[into] = stamps(rows)
        for name in names:
            values[name][into] = _values(rows, name, empty)
    columns = {name: column(name, [values.pop(name)]) for name in names}
    return Series(columns["simulated_time"], stamp, columns)


def _values(rows: NDArray[Any], name: str, empty: Mapping[str, Any]) -> NDArray[Any]:
    """Values of a field in each row."""
    if name in (rows.dtype.names or ()):
        return rows[name]
    value = np.asarray(empty[name])
    value = value.astype("S") if value.dtype.kind == "U" else value
    return np.broadcast_to(value, (len(rows), *value.shape))


def column(name: str, parts: list[NDArray[Any]]) -> NDArray[Any]:
    """Values of a field of successive messages; text is decoded.

    Raises:
        RecordingError: the shapes of the `parts` differ, or a text is not UTF-8.
    """
    try:
        values = np.concatenate(parts)
        if values.dtype.kind == "S":
            return np.asarray(np.char.decode(values, "utf-8"))
    except ValueError as reason:  # different shapes, or not UTF-8
        raise RecordingError(f"field {name} of a message: {reason}") from None
    return values.astype(values.dtype.newbyteorder("="), copy=False)
