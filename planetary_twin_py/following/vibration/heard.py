"""What vibration and the encoders show of one fault, as evidence of each other."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from ..estimate import Event

OF_A_TOOTH = "a tooth of the "
"""Begin of the cause of vibration that names a gear."""


def with_heard(events: Iterable[Event], heard: Iterable[Event]) -> list[Event]:
    """Events, and those heard in the vibration, with their support for a changed tooth."""
    others, heard = list(events), list(heard)
    return [
        *(_supported(event, [h for h in heard if _same(event, h)]) for event in others),
        *(_supported(h, [event for event in others if _same(event, h)]) for h in heard),
    ]


def _same(event: Event, heard: Event) -> bool:
    """Whether both may show a change of the same tooth."""
    gear = event.what.partition(" tooth ")[0].partition("_")[0]
    named = f"{OF_A_TOOTH}{gear}" in heard.causes
    return named and event.since <= heard.found and heard.since <= event.found


def _supported(event: Event, support: list[Event]) -> Event:
    if not support:
        return event
    texts = (f"{one.what}: {one.evidence.partition('; ')[0]}" for one in support)
    return replace(event, evidence=f"{event.evidence}; {'; '.join(texts)}")
