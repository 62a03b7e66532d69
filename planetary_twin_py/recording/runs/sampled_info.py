"""What is known of sensors with samples from a few of their blocks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from .block_order import counted
from .sampled import SampledSensor


@dataclass
class SampledInfo:
    """A topic with blocks of samples."""

    rate: float
    """Sample rate [Hz]."""
    channels: dict[str, str]
    """Units by channel."""
    missing: int = 0
    """Blocks that are missing between the first and the last, by their numbers."""
    doubled: int = 0
    """Blocks that are recorded again."""

    def figures(self) -> dict[str, Any]:
        """For JSON."""
        return {
            "sample_rate_hz": self.rate,
            "channels": self.channels,
            "missing_blocks": self.missing,
            "doubled_blocks": self.doubled,
        }

    def text(self) -> str:
        """One line."""
        channels = ", ".join(f"{name} [{unit}]" for name, unit in self.channels.items())
        line = f"{channels} at {self.rate:g} Hz"
        if self.missing:
            line += f", {counted(self.missing)} missing"
        if self.doubled:
            line += f", {counted(self.doubled)} recorded twice"
        return line

    def join(self, blocks: Sequence[Any], last: Any | None) -> None:
        """Count the blocks of the next file.

        Args:
            blocks: its messages, at least one.
            last: the last message of the file before; None if there is none.
        """
        if last is not None:
            self._compare(last, blocks[0])
        self._count(blocks, 0, len(blocks) - 1)

    def _count(self, blocks: Sequence[Any], first: int, last: int) -> None:
        """Count between two blocks by bisection: numbers without a gap need no further look."""
        begin, end = blocks[first], blocks[last]
        if end.sequence - begin.sequence == last - first:
            return
        if last == first + 1:
            self._compare(begin, end)
            return
        middle = (first + last) // 2
        self._count(blocks, first, middle)
        self._count(blocks, middle, last)

    def _compare(self, before: Any, after: Any) -> None:
        step = int(after.sequence) - int(before.sequence)
        self.missing += max(step - 1, 0)
        self.doubled += step == 0


def first_look(block: Any) -> SampledInfo:
    """Rate and channels of a block."""
    channels = dict(zip(map(str, block.names), map(str, block.units), strict=False))
    period = float(block.sample_period)
    return SampledInfo(1.0 / period if period > 0.0 else 0.0, channels)


def whole_look(sensor: SampledSensor) -> SampledInfo:
    """The same, by every block."""
    channels = dict(zip(*sensor.channels, strict=True))
    return SampledInfo(sensor.rate, channels, sensor.order.missing, sensor.order.doubled)
