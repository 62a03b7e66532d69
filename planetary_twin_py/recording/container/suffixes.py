"""File suffixes of readable tables; importing them does not import the packages for reading."""

from __future__ import annotations

from pathlib import Path

SUFFIXES = (
    ".csv", ".parquet", ".mat", ".txt", ".tsv", ".dat", ".wav", ".h5", ".hdf5", ".tdms"
)  # fmt: skip
TABLES = f"a table must end in {', '.join(SUFFIXES[:-1])} or {SUFFIXES[-1]}: convert other files"
"""Advice for a file of another kind."""


def is_table(path: Path) -> bool:
    """Whether the name of a file is that of a table."""
    return path.suffix.lower() in SUFFIXES
