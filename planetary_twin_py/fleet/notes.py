"""Writes the state of a fleet as a table."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..following.balance.follower import UNITS
from ..recording.tables.table_files import write_batches
from .groups import GearboxResult


def write_state(path: Path, found: Sequence[GearboxResult]) -> None:
    """Write one row for each gearbox to a .csv, .parquet or .npz file."""
    last = [result.events[-1] if result.events else None for result in found]
    fields: list[tuple[str, str, Sequence[object]]] = [
        ("gearbox", "", [result.gearbox for result in found]),
        ("readings", "", [result.readings for result in found]),
        ("missing", "", [result.missing[0] for result in found]),
        ("first_missing", "s", [result.missing[1] for result in found]),
        *(
            (f"{name}{part}", UNITS[name], [result.estimates[name][n] for result in found])
            for name in found[0].estimates
            for n, part in enumerate(("", "_low", "_high"))
        ),
        ("fits", "", [int(result.fits) for result in found]),
        ("fault", "", [result.fault for result in found]),
        ("events", "", [len(result.events) for result in found]),
        ("last_event", "s", [np.nan if event is None else event.found for event in last]),
        ("last_size", "N m", [np.nan if event is None else event.size for event in last]),
        ("scatter", "N m", [result.scatter[0] for result in found]),
        ("smallest_step", "", [result.smallest_step for result in found]),
    ]
    if any(result.damage is not None for result in found):
        damage = [result.damage for result in found]
        fields += [
            ("worst_part", "", ["" if one is None else one.worst for one in damage]),
            ("largest_damage", "", [np.nan if one is None else one.sums.max() for one in damage]),
            *(
                (
                    f"{name}_time",
                    "s",
                    [np.nan if one is None else one.seconds(name) for one in damage],
                )
                for name in ("counted", "unknown", "outside")
            ),
        ]
    batch = {name: np.array(values) for name, _, values in fields}
    write_batches(path, {name: unit for name, unit, _ in fields}, [batch])
