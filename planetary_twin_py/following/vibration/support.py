"""What vibration and the encoders show of one fault, as evidence of each other."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from ..estimate import Event

OF_A_TOOTH = "a tooth of the "
"""Begin of the cause of vibration that names a gear."""


def with_support(events: Iterable[Event]) -> list[Event]:
    """Events, each with those of another device that support it."""
    every = list(events)
    return [
        _supported(one, [other for other in every if _same(one, other) or _same(other, one)])
        for one in every
    ]


def _same(event: Event, vibration: Event) -> bool:
    """Whether both may show a change of the same tooth."""
    gear = event.what.partition(" tooth ")[0].partition("_")[0]
    named = f"{OF_A_TOOTH}{gear}" in vibration.causes
    return named and event.since <= vibration.found and vibration.since <= event.found


def _supported(event: Event, support: list[Event]) -> Event:
    if not support:
        return event
    texts = (f"{one.what}: {one.evidence.partition('; ')[0]}" for one in support)
    return replace(event, evidence=f"{event.evidence}; {'; '.join(texts)}")
