"""How long a twin waits for its recorder."""

from __future__ import annotations

import time
from collections.abc import Callable

_LONG = 1.0  # [s] after which waiting is a state that reports show


class Hold:
    """Holds a twin while its recorder has, as `has_room` says, not kept up."""

    def __init__(self, has_room: Callable[[], bool]) -> None:
        self._has_room = has_room
        self._begun = self._looked = 0.0  # [s] of the hold in progress; 0: there is none
        self.total = 0.0
        """[s] that all holds together have lasted."""

    @property
    def active(self) -> bool:
        """Whether the twin is held."""
        return self._begun > 0.0

    @property
    def long(self) -> bool:
        """Whether it has been for more than a second."""
        return self.active and self._looked > self._begun + _LONG

    def look(self) -> None:
        """Look whether the twin has to wait."""
        now = time.monotonic()
        if self.active:
            self.total += now - self._looked
        self._looked = now
        if self._has_room():
            self._begun = 0.0
        elif not self.active:
            self._begun = now

    def end(self) -> None:
        """Hold it no longer: time stands for another reason."""
        self._begun = 0.0
