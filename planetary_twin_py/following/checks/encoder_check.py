"""Compares the turns of both encoders with the teeth.

Their ratio must be that of the teeth, apart from the twist of the train, which is small against a
turn. Wrong counts per turn, reversed and exchanged encoders change it; the reader concludes which.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..input_error import InputError
from ..train import FollowedTrain
from ..transmission_error import Counts

STRETCH = 1.0  # turn of the slower member over which a ratio is measured
STRETCHES = 3  # whose median counts, because packets may be missing and turns may be lost
NEAR = 0.01  # relative deviation within which two ratios agree


@dataclass
class EncoderCheck:
    """Compares the first turns of both encoders with the teeth."""

    train: FollowedTrain
    counts_per_turn: tuple[int, int]
    _begin: tuple[int, int] | None = None  # counts at the begin of the stretch
    _ratios: list[float] = field(default_factory=list)

    def add(self, counts: Counts) -> None:
        """Add counts of both encoders, (n, 2).

        Raises `InputError` if the ratio of the turns is not that of the teeth.
        """
        while len(counts) and len(self._ratios) < STRETCHES:
            if self._begin is None:
                self._begin = int(counts[0, 0]), int(counts[0, 1])
            first, second = self.counts_per_turn
            turned = (counts[:, 0] - self._begin[0]) / first
            enough = np.abs(turned) * min(1.0, abs(self.train.ratio)) >= STRETCH
            if not enough.any():
                return
            k = int(np.argmax(enough))
            other = (int(counts[k, 1]) - self._begin[1]) / second
            self._ratios.append(other / float(turned[k]))
            self._begin, counts = None, counts[k:]
            if len(self._ratios) == STRETCHES:
                self._check_ratio(float(np.median(self._ratios)))

    def _check_ratio(self, ratio: float) -> None:
        expected, (first, second) = self.train.ratio, self.counts_per_turn
        if abs(ratio / expected - 1.0) < NEAR:
            return
        raise InputError(
            f"encoders: turns of the output/turns of the input = {ratio:.4g}: must be "
            f"{expected:.4g} by the teeth; which encoder is on which shaft, does each count in its "
            f"direction, are its counts per turn {first} (input) and {second} (output), and do "
            "the counts include whole turns?"
        )
