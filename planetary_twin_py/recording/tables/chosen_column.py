"""Which column of a table an option selects, and the unit that it states."""

from __future__ import annotations

from pathlib import Path

from ...text.escaping import one_line
from .measurements import Column, name_and_unit


def state_units(
    path: Path, columns: dict[str, Column], option: str, name: str | None, text: str | None
) -> None:
    """Add the unit that an option such as `--speed "speed [rpm]"` states to its column.

    Args:
        path: of the table, for messages.
        columns: by name; one with a stated unit is replaced.
        option: for messages.
        name: of its column; None if it is not given.
        text: of the option.

    Raises:
        ValueError: the table states another unit.
    """
    _, unit = name_and_unit(text or "")
    if unit is None or name is None:
        return
    if columns[name].unit not in (None, unit):
        raise ValueError(
            f"{path}: {option} = {text!r}: the column {columns[name].heading!r} is in "
            f"[{columns[name].unit}]"
        )
    columns[name] = columns[name]._replace(unit=unit)


def chosen(
    path: Path, option: str, column: str | None, names: list[str], every: list[str] | None = None
) -> str:
    """Name of the column that `option` selects.

    Args:
        path: of the table, for messages.
        option: for messages.
        column: name or number, perhaps with a unit; None if there is only one.
        names: of the columns that may be selected.
        every: names of all columns, which numbers count from 1 on; None is `names`.

    Raises:
        ValueError: there is no such column, or none was named and there are several.
    """
    column_name = name_and_unit(column)[0] if column is not None else None
    if column_name in names:
        return column_name
    if column is None and len(names) == 1:
        return names[0]
    numbered = names if every is None else every
    if column_name is not None and column_name.isdigit():
        number = int(column_name)
        if 1 <= number <= len(numbered) and numbered[number - 1] in names:
            return numbered[number - 1]
    given = (
        f"choose one with {option}" if column is None else f"{option} = {column!r}: no such column"
    )
    raise ValueError(f"{path}: {given}; columns: {listed(names)}")


def listed(names: list[str]) -> str:
    """Names of columns, for messages."""
    return one_line(", ".join(names), 400) or "none besides the time"
