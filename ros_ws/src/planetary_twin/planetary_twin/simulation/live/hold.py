"""Makes a twin wait until its recorder has caught up."""

from __future__ import annotations

import time
from collections.abc import Callable

_LONG = 1.0  # [s] longer waits are shown in reports


class Hold:
    """Makes a twin wait while `has_room` returns False: its recorder has not kept up."""

    def __init__(self, has_room: Callable[[], bool]) -> None:
        self._has_room = has_room
        self._start = self._checked = 0.0  # [s] of the present wait; 0: none
        self.total = 0.0
        """Total duration of all waits [s]."""

    @property
    def active(self) -> bool:
        """Whether the twin waits."""
        return self._start > 0.0

    @property
    def long(self) -> bool:
        """Whether the twin has waited for more than a second."""
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
        """End the wait: time is stopped for another reason."""
        self._start = 0.0
