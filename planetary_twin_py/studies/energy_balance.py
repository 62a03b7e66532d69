"""Warning about points of a study whose energy ledger does not balance."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from ..checks.ledger import advice
from ..units.catalogue import EXCESS

if TYPE_CHECKING:
    import pyarrow as pa


def unbalanced_runs(table: pa.Table) -> str | None:
    """Warning with the number of points whose energy ledger does not balance.

    Args:
        table: table from `tabulate`, with its settings.

    Returns:
        A sentence, or None if the ledgers of all points balance.
    """
    excesses = [excess or 0.0 for excess in table[EXCESS].to_pylist()]
    largest, points = max(excesses, default=0.0), sum(excess > 1.0 for excess in excesses)
    if not points:
        return None
    tolerance = json.loads(table.schema.metadata[b"settings"])["tolerance"]
    return (
        f"the energy ledger does not balance at {points} of {len(table)} points ({EXCESS} up to "
        f"{largest:.3g}); their losses and efficiency are uncertain; {advice(largest, tolerance)}"
    )
