"""Changes of the operating point, as log lines and as step curves."""

from __future__ import annotations

import numpy as np
import rerun as rr

from ..recording.runs.reader import Recording
from ..units.catalogue import OPERATING_POINT
from . import timeline
from .layer import Layer

_COLOUR = (120, 196, 140)


def log_events(layer: Layer, recording: Recording, known: int = 0) -> None:
    """Log each change at /changes, and every set-point as a step curve at /operating_point/NAME.

    Args:
        layer: recording to draw into.
        recording: has the operating points.
        known: number of operating points that are already logged.
    """
    point = recording.operating_point
    if not len(point):
        return
    text = [layer.label(sentence(recording, row)) for row in range(known, len(point))]
    index = timeline.columns(point.time[known:], point.stamp[known:])
    level = ["INFO"] * len(text)
    layer.send_columns("changes", index, rr.TextLog.columns(text=text, level=level))
    # The last values apply until the end of the recording.
    last = len(recording.state) - 1
    index = timeline.columns(
        np.append(point.time[known:], recording.state.time[last]),
        np.append(point.stamp[known:], recording.state.stamp[last]),
    )
    for name, quantity in OPERATING_POINT.items():
        style = layer.lines([name], [_COLOUR], steps=True)
        layer.log(f"operating_point/{name}", style, static=True)
        values = quantity.factor * np.append(point[name][known:], point[name][-1])
        layer.send_columns(f"operating_point/{name}", index, rr.Scalars.columns(scalars=values))


def sentence(recording: Recording, row: int) -> str:
    """Changed set-points with new and old values; all values for the first message.

    Args:
        recording: has the operating points.
        row: index of the operating point.
    """
    point = recording.operating_point
    changed = [name for name in str(point["changed"][row]).split(",") if name in OPERATING_POINT]
    if row == 0 or not changed:
        return "initial: " + ", ".join(_value(recording, name, row) for name in OPERATING_POINT)
    return "; ".join(
        f"{_value(recording, name, row)}, was {_number(recording, name, row - 1)}"
        for name in changed
    )


def _value(recording: Recording, name: str, row: int) -> str:
    unit = OPERATING_POINT[name].unit
    return f"{name} = {_number(recording, name, row)}" + ("" if unit == "-" else f" {unit}")


def _number(recording: Recording, name: str, row: int) -> str:
    value = OPERATING_POINT[name].factor * recording.operating_point[name][row]
    return "computed" if np.isnan(value) else f"{value:.4g}"
