"""Turning points of the torques of shafts that are in no closed cycle yet, in the core."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from .._core import Passages
from .parts import SHAFTS

PARTS = tuple(f"{side}_shaft" for side in SHAFTS)
"""Names of the shafts as parts, in the order of the core."""


def read_turning(passages: Passages) -> dict[str, tuple[float, ...]]:
    """Turning points so far [N m], by shaft; none of shafts without a rating."""
    histories = zip(PARTS, passages.shaft, strict=False)
    return {
        part: tuple(history.turn[: history.count].tolist())
        for part, history in histories
        if history.count
    }


def put_turning(passages: Passages, turning: Mapping[str, Sequence[float]]) -> None:
    """Go on from turning points [N m], by shaft: of each the newest for which there is room."""
    for part, history in zip(PARTS, passages.shaft, strict=False):
        turns = turning.get(part, ())[-len(history.turn) :]
        history.count = len(turns)
        history.turn[: len(turns)] = turns
