"""Holds a twin until its recorder has caught up."""

from __future__ import annotations

import time
from collections.abc import Callable

_LONG = 1.0  # [s] after which reports show that the twin waits


class Hold:
    """Holds a twin while `has_room` returns False: its recorder has not kept up."""

    def __init__(self, has_room: Callable[[], bool]) -> None:
        self._has_room = has_room
        self._start = self._checked = 0.0  # [s] of the hold in progress; 0: none
        self.total = 0.0
        """Total duration of all holds [s]."""

    @property
    def active(self) -> bool:
        """Whether the twin is held."""
        return self._start > 0.0

    @property
    def long(self) -> bool:
        """Whether the twin has been held for more than a second."""
        return self.active and self._checked > self._start + _LONG

    def update(self) -> None:
        """Check whether the twin has to wait."""
        now = time.monotonic()
        if self.active:
            self.total += now - self._checked
        self._checked = now
        if self._has_room():
            self._start = 0.0
        elif not self.active:
            self._start = now

    def end(self) -> None:
        """End the hold: time is stopped for another reason."""
        self._start = 0.0
