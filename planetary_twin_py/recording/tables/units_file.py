"""Units of the columns of a table, in a file beside it."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

LONGEST = 1_000_000  # [bytes] of a file


def units_file(path: Path) -> Path:
    """Path of the units of a table, NAME.units.json."""
    return path.with_suffix(".units.json")


def write_units(path: Path, units: Mapping[str, str]) -> None:
    """Write the units of a table beside it.

    Args:
        path: path of the table.
        units: unit by heading.

    Raises:
        OSError: the file cannot be written.
    """
    units_file(path).write_text(json.dumps(units, indent=2) + "\n", "utf-8")


def units_beside(path: Path) -> dict[str, str]:
    """Read the units of a table.

    Returns:
        Unit by heading; empty without a file beside the table.

    Raises:
        ValueError: the file is not one of `write_units`.
        OSError: the file cannot be read.
    """
    file = units_file(path)
    if not file.is_file():
        return {}
    if file.stat().st_size > LONGEST:
        raise ValueError(f"{file}: must be at most {LONGEST} bytes")
    try:
        units = json.loads(file.read_text("utf-8"))
    except (ValueError, RecursionError):
        raise ValueError(f"{file}: must be JSON in UTF-8") from None
    if not isinstance(units, dict) or not all(isinstance(unit, str) for unit in units.values()):
        raise ValueError(f"{file}: must be an object with a unit as text for each heading")
    return units
