"""Stamps of messages."""

from __future__ import annotations

from typing import Any


def seconds(stamp: Any) -> float:
    """Time of a stamp [s]."""
    return float(stamp.sec + 1e-9 * stamp.nanosec)


def stamp_of(message: Any) -> float:
    """Stamp of a message with a header [s]."""
    return seconds(message.header.stamp)
