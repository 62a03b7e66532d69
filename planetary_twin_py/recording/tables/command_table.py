"""Reads a table of commands at the ports: a time in each row, and a column for each quantity."""

from __future__ import annotations

from pathlib import Path

from ...run.commands import NAMES, UNITS, Commands
from ...scene.names import did_you_mean
from .measurements import TIME, missing_column, naming, read_columns


def read_commands(path: Path) -> Commands:
    """Read a CSV or Parquet file of commands, with the columns of `Commands`.

    Args:
        path: path of the file. Headings are `time` and names such as `output_torque`, with a unit
            in brackets unless it is SI: `input_speed [rpm]`. An empty cell leaves a port as it is.

    Returns:
        The commands in SI.

    Raises:
        ValueError: a heading or a value is invalid, or times do not increase.
        OSError: the file cannot be read.
    """
    table = read_columns(path)
    for name, column in table.items():
        if name not in (TIME[0], *NAMES):
            near = did_you_mean(name, [TIME[0], *NAMES])
            expected = near or f"; must be {TIME[0]} or one of {', '.join(NAMES)}"
            raise ValueError(f"{path}: column {column.heading!r}: no such quantity{expected}")
    if TIME[0] not in table:
        raise missing_column(path, TIME[0], table)
    if len(table) == 1:
        raise ValueError(f"{path}: has no column of commands; possible: {', '.join(NAMES)}")
    units = {TIME[0]: "s"} | {name: UNITS[name.split("_")[1]] for name in NAMES}
    columns = {name: column.in_si(name, units[name]) for name, column in table.items()}
    with naming(path):
        return Commands(**columns)
