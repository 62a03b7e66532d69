"""Damage of a gearbox for `planetary-twin follow`: a table and lines."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..durability.damage_state import DamageState
    from ..terminal.tables import TableConsole

SHOWN = 1e-12  # damage below which a part has no row


def print_damage(console: TableConsole, state: DamageState) -> None:
    """Print the damage of the parts, and what was replaced."""
    from ..terminal.tables import table

    columns = zip(state.parts, state.sums, state.rates, state.remaining_hours, strict=True)
    rows = [
        [part, f"{damage:.4g}", f"{rate:.3g}", f"{left:.4g}"]
        for part, damage, rate, left in columns
        if damage > SHOWN
    ]
    headings = "part", "damage", "per hour", "hours to 1"
    title = f"damage of {state.hours:.6g} h"
    console.print(table(headings, rows, title=title, texts=("part",)))
    for line in _lines(state):
        console.one_line(line)


def not_in_the_sums(state: DamageState) -> str | None:
    """A line on times whose damage is not known; None without any."""
    unknown, outside = state.seconds("unknown"), state.seconds("outside")
    if not unknown and not outside:
        return None
    return (
        f"not in the sums: {unknown / 3600.0:.4g} h of gaps, {outside / 3600.0:.4g} h outside the "
        "map"
    )


def _lines(state: DamageState) -> Iterator[str]:
    if missing := not_in_the_sums(state):
        yield missing
    for entry in state.replaced:
        yield f"{entry.part} replaced after {entry.hours:.6g} h with damage {entry.damage:.4g}"
