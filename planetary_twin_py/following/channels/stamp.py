"""Stamps of messages."""

from __future__ import annotations

from typing import Any


def stamp_of(message: Any) -> float:
    """Stamp of a message with a header [s]."""
    stamp = message.header.stamp
    return float(stamp.sec + 1e-9 * stamp.nanosec)
