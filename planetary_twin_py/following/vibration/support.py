"""What vibration and the encoders show of one fault, as evidence of each other."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from ..estimate import Event

OF_A_TOOTH = "a tooth of the "
"""Begin of the cause of vibration that names a gear."""


def with_support(events: Iterable[Event], vibration: Iterable[Event]) -> list[Event]:
    """Events, and those of the vibration, with their support for a changed tooth."""
    others, shown = list(events), list(vibration)
    return [
        *(_supported(event, [one for one in shown if _same(event, one)]) for event in others),
        *(_supported(one, [event for event in others if _same(event, one)]) for one in shown),
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
