"""A duty: torque, speed and oil temperature over time, or how long each combination lasts."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..recording.tables.measurements import TIME, Column, missing_column, naming, read_columns
from ..recording.tables.time_steps import day_numbers
from ..scene import TUNABLES
from ..scene.names import did_you_mean

Array = NDArray[np.float64]

NAMES = {"torque": "input_torque", "speed": "input_speed", "torque_std": "input_torque_std"}
"""Short names of columns."""
REQUIRED = ("input_torque", "input_speed")
STD = "input_torque_std"
DURATION, SHARE = "duration", "share"
ROUNDING = 1e-3  # by which shares may miss 1
GAP = 20.0  # times the median from which on a row looks like an outage
MANY = 20  # rows that have a median


class Duty(NamedTuple):
    """Rows of a duty."""

    held: Array
    """How long each row holds [s]; of shares, for one second in total, (rows,)."""
    columns: dict[str, Array]
    """Quantities of the operating point by name, and perhaps `input_torque_std`, in SI, (rows,)
    each."""
    time: Array | None = None
    """Start of each row [s], ascending, (rows,); None of a duty without order."""
    shares: bool = False
    """Whether only shares of the time are known, so the duty has no duration of its own."""
    remarks: tuple[str, ...] = ()
    """What is doubtful about it."""

    @property
    def duration(self) -> float:
        """Sum of all rows [s]."""
        return float(self.held.sum())


def read_duty(
    path: str | Path, known: Collection[str] = (*REQUIRED, "oil_temperature", STD)
) -> Duty:
    """Read a duty from a table, with units in the headings, such as `speed [rpm]`, or in SI.

    Args:
        path: .csv or .parquet with the columns `torque` and `speed` of the first motor and, where
            they are known, `oil_temperature` and `torque_std`: standard deviation of the torque
            within a row. A series has `time`: each row holds up to the time of the next one; the
            last row only ends the duty. Otherwise rows have a `duration`, or a `share` of the time.
        known: names of the columns besides these times.

    Returns:
        The rows in SI.

    Raises:
        ValueError: a column is missing or unknown, or several say how long rows hold; a value is
            missing; times do not increase; shares do not add up to 1.
        OSError: the file cannot be read.
    """
    path = Path(path)
    table = {NAMES.get(name, name): column for name, column in read_columns(path).items()}
    spans = [name for name in (TIME[0], DURATION, SHARE) if name in table]
    if len(spans) != 1:
        given = " and ".join(spans) or "none of them"
        raise ValueError(
            f"{path}: columns time, duration, share: has {given}; must have one of them, which "
            "says how long each row holds"
        )
    _check_names(path, table, spans[0], known)
    columns = {name: column.in_si(name, _unit(name)) for name, column in table.items()}
    for name, values in columns.items():
        for row in np.flatnonzero(~np.isfinite(values))[:1]:
            raise ValueError(f"{path}: row {row + 1}: {name} is missing")
    span = columns.pop(spans[0])
    for row in np.flatnonzero(columns.get(STD, np.zeros(0)) < 0.0)[:1]:
        raise ValueError(f"{path}: row {row + 1}: {STD}: must be at least 0")
    with naming(path):
        return _series(span, columns) if spans[0] == TIME[0] else _bins(span, columns, spans[0])


def _unit(name: str) -> str:
    units = {TIME[0]: "s", DURATION: "s", SHARE: "", STD: "N m"}
    return units[name] if name in units else TUNABLES[name].unit


def _check_names(
    path: Path, table: Mapping[str, Column], span: str, known: Collection[str]
) -> None:
    for name, column in table.items():
        if name != span and name not in known:
            names = [TIME[0], DURATION, SHARE, *NAMES, *known]
            expected = did_you_mean(name, names) or f"; must be one of {', '.join(names)}"
            raise ValueError(f"{path}: column {column.heading!r}: no such quantity{expected}")
    for name in REQUIRED:
        if name not in table:
            raise missing_column(path, name, table)


def _series(time: Array, columns: dict[str, Array]) -> Duty:
    if len(time) < 2:
        raise ValueError("must have two rows or more: the last one ends the cycle")
    held = np.diff(time)
    for row in np.flatnonzero(held <= 0.0)[:1]:
        raise ValueError(f"row {row + 2}: time = {time[row + 1]:g} s: must increase")
    if advice := day_numbers(time):
        raise ValueError(advice)
    rows = {name: values[:-1] for name, values in columns.items()}
    return Duty(held, rows, time[:-1], remarks=_outages(held))


def _outages(held: Array) -> tuple[str, ...]:
    usual = float(np.median(held))
    long = np.flatnonzero(held > GAP * usual)
    if len(held) < MANY or not len(long):
        return ()
    return (
        f"{len(long)} rows hold for more than {GAP:g} times the usual {usual:g} s, the first is "
        f"row {long[0] + 1} with {held[long[0]]:g} s: an outage counts as if the row lasted",
    )


def _bins(span: Array, columns: dict[str, Array], name: str) -> Duty:
    for row in np.flatnonzero(span < 0.0)[:1]:
        raise ValueError(f"row {row + 1}: {name} = {span[row]:g}: must be at least 0")
    total = float(span.sum())
    if name == SHARE and abs(total - 1.0) > ROUNDING:
        raise ValueError(f"share: adds up to {total:.6g}, must be 1 (100 %)")
    if not total > 0.0:
        raise ValueError(f"{name}: adds up to 0 s, must be above")
    return Duty(span / total if name == SHARE else span, columns, shares=name == SHARE)
