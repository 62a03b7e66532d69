"""Follows the samples of two encoders: their whole turns, their speed, and the teeth."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..scene import Scene
from .balance.follower import BalanceFollower
from .channels.encoders import EncoderFormat, EncoderSamples
from .checks.encoder_speed import EncoderSpeed
from .checks.sample_check import CountCheck
from .checks.whole_turns import WholeTurns
from .teeth.follower import TeethFollower


class EncoderFollower:
    """Two encoders whose format is known, beside the torque balance that gives speed and torque."""

    def __init__(
        self, scene: Scene, encoders: EncoderFormat, learning: int, balance: BalanceFollower
    ) -> None:
        self._balance, self._speed = balance, EncoderSpeed(*encoders)
        self._turns = WholeTurns(CountCheck(balance.train, *encoders))
        self.teeth = TeethFollower(scene, *encoders, learning)

    def add(self, block: EncoderSamples) -> None:
        """Add samples in the order of their arrival."""
        sample, counts = self._turns.add(block.sample, block.counts)
        self.teeth.add(sample, counts)
        self._speed.add(sample, counts)

    def judge(self, until: float) -> None:
        """Judge what the encoders show up to a time [s]."""
        self._speed.judge(until, self._balance.turning_between)
        self.teeth.judge(until, self._balance.torque_between)

    def finish(self) -> None:
        """Process the samples that are held back, at the end of a recording."""
        if math.isfinite(self._balance.time):
            self._speed.judge(self._balance.time, self._balance.turning_between)
        self.teeth.finish()
        self.teeth.judge(math.inf, self._balance.torque_between)

    def remarks(self) -> Iterator[str]:
        """Reasons why teeth are judged worse, or not at all."""
        yield from self._turns.remarks()
        segments = self.teeth.counters.segments
        if segments > 1:
            yield (
                f"encoders: the count of turns restarted {segments - 1} times; teeth are numbered "
                "from each new start, and baselines are learned again"
            )
        yield from self.teeth.remarks()
        if self.teeth.blocks:
            yield from self._speed.remarks()
