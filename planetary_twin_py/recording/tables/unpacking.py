"""Limits how much larger the contents of a compressed file may be than the file."""

from __future__ import annotations

MOST_ADDED = 2**30
"""Bytes that unpacking may add to the size of a file: a few kilobytes can hold gigabytes."""


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
