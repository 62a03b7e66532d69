"""Recognises readings that are no speed of a shaft: pulses, rest, reversals and sudden jumps.

The speed of a shaft with inertia does not change by half from one sample to the next. A sensor that
counts a pulse twice, or misses one, reads twice or half of it.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

JUMP = 1.5  # ratio of successive speeds that no shaft has
SLOW = 0.2  # of the highest speed, below which a start or a stop has such ratios
LEVEL = 0.1  # of the range: values that are at an end of it
PULSES = 8  # changes from one end of the range to the other
BOTH = 0.05  # of the samples at each end of the range in a pulse train


class SpeedColumn(NamedTuple):
    """A column with the speed of a shaft."""

    name: str
    heading: str
    values: Array
    """In the unit of the heading, (n,)."""


def check_one_way(column: SpeedColumn, time: Array, first: int) -> None:
    """Check that a shaft turns in one direction, so that its angle may replace the time.

    Args:
        column: measured speed.
        time: time stamps [s], (n,).
        first: number of rows before these, for messages.

    Raises:
        ValueError: it rests or reverses from one sample to the next; the message has the first row,
            its time and value.
    """
    values = column.values
    forward = values * np.sign(values[np.flatnonzero(values)[:1]].sum() or 1.0)
    wrong = np.flatnonzero(forward[:-1] + forward[1:] <= 0.0)[:1]
    for place in wrong:
        row = int(place) + (forward[place] > 0.0)
        if is_pulse_train(values):
            cause = "is it a pulse train? Its values must be speeds"
        elif forward[row] == 0.0:
            moving = np.flatnonzero(forward[row:] != 0.0)
            last = row + int(moving[0]) - 1 if len(moving) else len(values) - 1
            cause = f"stands still until {time[last]:.6g} s, {last + 1 - row} rows; or no reading?"
        else:
            cause = "reverses"
        raise ValueError(
            f"row {first + row + 1}: {column.heading} = {values[row]:g} at {time[row]:.6g} s: "
            f"{cause}; orders need a shaft that turns in one direction: select an interval by "
            "--from and --to"
        )


def jump_remarks(column: SpeedColumn, time: Array, first: int) -> Iterator[str]:
    """A line if a speed jumps from one sample to the next.

    Args:
        column: measured speed.
        time: time stamps [s], (n,).
        first: number of rows before these, for messages.
    """
    size = np.abs(column.values)
    high = np.maximum(size[:-1], size[1:])
    jumps = 1 + np.flatnonzero(
        (JUMP * np.minimum(size[:-1], size[1:]) <= high) & (high > SLOW * size.max())
    )
    for row in jumps[:1]:
        before, after = column.values[row - 1 : row + 1]
        factor = f" to {after / before:.3g} times its value" if before and after else ""
        more = f", and {len(jumps) - 1} times later" if len(jumps) > 1 else ""
        yield (
            f"the column {column.heading!r} jumps{factor} at {time[row]:.6g} s (row "
            f"{first + row + 1}), from {before:.6g} to {after:.6g}{more}: does its sensor count "
            "pulses twice or miss some? Lines are lower and at wrong places by them"
        )


def is_pulse_train(values: Array) -> bool:
    """Whether values change many times between two levels, as those of a pulse per turn do.

    Args:
        values: in any unit, (n,).
    """
    low, span = values.min(), np.ptp(values)
    at_low, at_high = values <= low + LEVEL * span, values >= low + (1.0 - LEVEL) * span
    changes = np.count_nonzero(np.diff(at_high.astype(np.int8)))
    rare = min(at_low.mean(), at_high.mean())
    return bool(
        changes >= PULSES and rare >= BOTH and (at_low | at_high).mean() > 1.0 - 2.0 * LEVEL
    )
