"""Damage that a run has when it is simulated again."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from typing import Any

from ...durability.damage_state import Replacement
from ...run.window import Window
from .origin import damage_at
from .schedule import RecordedRun


class Replacements:
    """Parts that were replaced in a run, in order."""

    def __init__(self, run: RecordedRun) -> None:
        self._waiting = deque(run.replaced)

    def due(self, time: float) -> Iterator[Replacement]:
        """Those that have been replaced by a time and were not due before.

        Args:
            time: simulated time [s].
        """
        while self._waiting and self._waiting[0].time <= time:
            yield self._waiting.popleft()


class ExpectedDamage:
    """Messages of damage of a run, interval by interval."""

    def __init__(self, run: RecordedRun) -> None:
        self._damage, self._replaced = damage_at(run.origin), Replacements(run)

    def of(self, window: Window) -> dict[str, dict[str, Any]]:
        """Fields of the messages after the next window, by topic."""
        if self._damage is None or window.damage is None:
            return {}
        for entry in self._replaced.due(window.start):
            self._damage.replace_part(entry.part, entry.time)
        self._damage.add(window.damage)
        return self._damage.messages(window.start, window.end)
