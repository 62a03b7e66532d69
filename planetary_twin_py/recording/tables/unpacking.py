"""Limits the memory that the contents of a file may take."""

from __future__ import annotations

MOST_ADDED = 2**30
"""Bytes that unpacking may add to the size of a file: a few kilobytes can hold gigabytes."""
_MOST_COLUMNS = 2000


class UnpackedTooLargeError(ValueError):
    """The contents of a file are too large."""


def check_unpacked(packed: float, unpacked: float) -> None:
    """Check a size before memory is taken for it.

    Args:
        packed: size in the file [B].
        unpacked: size in memory [B].

    Raises:
        UnpackedTooLargeError: unpacking adds more than `MOST_ADDED`.
    """
    if unpacked - packed > MOST_ADDED:
        raise UnpackedTooLargeError(
            f"unpacks from {packed / 1e6:.3g} MB to {unpacked / 1e6:.4g} MB: may add at most "
            f"{MOST_ADDED / 1e6:.0f} MB; split it"
        )


def check_columns(number: int) -> None:
    """Refuse a table before its columns take memory: 10 kB each, whatever they hold.

    Args:
        number: of the columns.

    Raises:
        ValueError: there are too many.
    """
    if number > _MOST_COLUMNS:
        raise ValueError(f"has {number} columns: must be at most {_MOST_COLUMNS}")
