"""Points of a study whose energy ledger does not close, in words."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from ..ledger_check import advice
from .measures import EXCESS

if TYPE_CHECKING:
    import pyarrow as pa


def unclosed_ledgers(table: pa.Table) -> str | None:
    """A sentence where the ledger of a point of a study does not close, else None.

    Args:
        table: of `tabulate`, with its settings.
    """
    excesses = [excess or 0.0 for excess in table[EXCESS].to_pylist()]
    largest, points = max(excesses, default=0.0), sum(excess > 1.0 for excess in excesses)
    if not points:
        return None
    tolerance = json.loads(table.schema.metadata[b"settings"])["tolerance"]
    return (
        f"the energy ledger does not close at {points} of {len(table)} points ({EXCESS} up to "
        f"{largest:.3g}), whose losses and efficiency are uncertain; {advice(largest, tolerance)}"
    )
