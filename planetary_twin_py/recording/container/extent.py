"""The time interval that messages cover."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass
class Extent:
    """First and last log time [ns since the epoch] of a file's messages."""

    start: int = 0
    end: int = 0

    def include(self, time: int) -> None:
        """Extend the interval to `time`."""
        self.start = min(self.start, time) if self.start else time
        self.end = max(self.end, time)
