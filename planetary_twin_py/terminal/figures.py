"""Figures that commands show: lines, rows of a table, and JSON, all by their quantities."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from ..units.engineering import figure

if TYPE_CHECKING:
    from ..units.shown import Quantities
    from .tables import TableConsole

Values = Mapping[str, Any]


def text_of(value: Any, unit: str, digits: int = 4, missing: str = "-") -> str:
    """Format a value, or several separated by strokes.

    Args:
        value: number in SI, text, tuple of them, or None.
        unit: SI unit.
        digits: significant digits of a number.
        missing: text in place of None.
    """
    if isinstance(value, tuple):
        return "/".join(text_of(part, unit, digits, missing) for part in value)
    if value is None:
        return missing
    return figure(value, unit, digits) if isinstance(value, float) else str(value)


def print_lines(console: TableConsole, quantities: Quantities, values: Values) -> None:
    """Print a line for each value: its title, and the value with its unit.

    Args:
        console: where to print.
        quantities: by key.
        values: in SI, or texts, by key; a key that is missing has no line.
    """
    shown = {key: quantity for key, quantity in quantities.items() if key in values}
    width = max(len(quantity.title) for quantity in shown.values()) + 2
    for key, quantity in shown.items():
        value = text_of(values[key], quantity.si, digits=6)
        console.print(f"{quantity.title:{width}}{value}", markup=False)


def rows(quantities: Quantities, *columns: Values, missing: str = "-") -> Iterator[list[str]]:
    """Rows of a table: what a quantity is, then its value in each column.

    Args:
        quantities: by key.
        columns: values in SI by key.
        missing: text in place of None.
    """
    for key, quantity in quantities.items():
        values = (text_of(column[key], quantity.si, missing=missing) for column in columns)
        yield [quantity.text, *values]


def keyed(quantities: Quantities, values: Values) -> dict[str, Any]:
    """Values for JSON, by keys that name the unit.

    Args:
        quantities: by key.
        values: in SI, by key; those that are missing are left out.
    """
    from ..units.shown import key_with_unit

    return {
        key_with_unit(name, quantity): values[name]
        for name, quantity in quantities.items()
        if name in values
    }
