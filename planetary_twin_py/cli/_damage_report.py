"""Damage of a gearbox for `planetary-twin follow` and `fleet`: a table and lines, and figures."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from ..text.finite import finite

if TYPE_CHECKING:
    from ..durability.damage_state import DamageState
    from ..terminal.tables import TableConsole

SHOWN = 1e-12  # damage below which a part has no row


def print_damage(console: TableConsole, state: DamageState) -> None:
    """Print the damage of the parts, and what was replaced.

    Args:
        console: console to print on.
        state: the damage.
    """
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


def _lines(state: DamageState) -> Iterator[str]:
    unknown, outside = (float(sums.total) for sums in (state.times.unknown, state.times.outside))
    if unknown or outside:
        yield (
            f"not in the sums: {unknown / 3600.0:.4g} h of gaps, {outside / 3600.0:.4g} h outside "
            "the map"
        )
    for entry in state.replaced:
        yield f"{entry.part} replaced after {entry.hours:.6g} h with damage {entry.damage:.4g}"


def damage_figures(state: DamageState) -> dict[str, Any]:
    """The damage for `--json`.

    Args:
        state: the damage.
    """
    columns = {
        "damage": state.sums, "rate": state.rates, "remaining_hours": state.remaining_hours,
    }  # fmt: skip
    return {
        "hours": state.hours,
        "unknown_hours": float(state.times.unknown.total) / 3600.0,
        "outside_hours": float(state.times.outside.total) / 3600.0,
        "readings": vars(state.readings) | {"first_outside": finite(state.readings.first_outside)},
        "oil_temperature": {
            "mean": finite(state.mean_oil_temperature), "highest": finite(state.oil.highest),
        },
        "worst": state.worst or None,
        "parts": {
            part: {name: finite(float(values[n])) for name, values in columns.items()}
            | {"passages": state.passages[n]}
            for n, part in enumerate(state.parts)
        },
        "replaced": [
            {name: finite(value) for name, value in entry._asdict().items()}
            for entry in state.replaced
        ],
    }  # fmt: skip
