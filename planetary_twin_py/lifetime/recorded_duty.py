"""A duty from a recording of a twin."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..recording.runs.reader import read_recording
from .duty_table import Duty


def recorded_duty(path: Path, namespace: str | None = None) -> Duty:
    """Torque, speed and oil temperature of a recorded run, a row for each published interval.

    Args:
        path: an .mcap file, or a folder of them.
        namespace: of the gearbox; None if there is only one.

    Returns:
        The duty; times without messages are no part of it.

    Raises:
        ValueError: there is nothing to read, or no operating point.
        OSError: the file cannot be read.
    """
    found = read_recording(path, namespace)
    state, point = found.state, found.operating_point
    if not len(point):
        raise ValueError(f"{path}: {found.namespace}/operating_point: has no message with the oil")
    held = np.asarray(state["interval"], dtype=np.float64)
    begin = state.time - held
    at = np.maximum(np.searchsorted(point.time, begin + 0.5 * held, "right") - 1, 0)
    columns = {
        "input_torque": np.asarray(state["input_torque"], dtype=np.float64),
        "input_speed": np.asarray(state["input_speed"], dtype=np.float64),
        "oil_temperature": np.asarray(point["oil_temperature"], dtype=np.float64)[at],
    }
    known = np.isfinite(np.column_stack([held, *columns.values()])).all(axis=1) & (held > 0.0)
    columns = {name: values[known] for name, values in columns.items()}
    if not known.any():
        raise ValueError(f"{path}: {found.namespace}/gearbox_state: has no torque and speed")
    return Duty(held[known], columns, begin[known], remarks=tuple(found.remarks))
