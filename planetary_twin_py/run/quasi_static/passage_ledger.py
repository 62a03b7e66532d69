"""Damage of a quasi-static run: passages of tooth pairs, followed as the train turns.

In steady running a mesh cycle is followed once and multiplied, after those in which pairs enter
that were in mesh before.
"""

from __future__ import annotations

import math
from types import ModuleType
from typing import NamedTuple

import numpy as np

from ..._core import MeshSums, Model, Passages, State
from ...model.clock import Instant, delay

SETTLING = 4  # mesh cycles after which no pair is in mesh that was there before
ON_EDGE = 1e-9  # mesh cycles


class AtPoint(NamedTuple):
    """A quasi-static train at one operating point."""

    core: ModuleType
    """Build of the core with the model."""
    model: Model
    tolerance: float
    """Relative error of the mesh forces, and of the losses of a mesh cycle."""
    closing_side: int
    """Side of the teeth that carries the mean torque."""


class PassageLedger:
    """Damage since the start, at one operating point.

    Args:
        train: at this operating point.
        origin: position of the motors.
        passages: peaks of the tooth pairs in mesh, which are followed.
    """

    def __init__(self, train: AtPoint, origin: State, passages: Passages) -> None:
        self._core, self._model, self._tolerance, closing_side = train
        self._run, self._reached = self._core.first_guess(closing_side), origin.copy()
        self._passages = passages

    def follow(self, time: Instant, edges: np.ndarray, sums: MeshSums, repeats: bool) -> None:
        """Fill the damage and the extremes of `sums` from the previous call to `time`.

        Args:
            time: not before that of the previous call.
            edges: of the panels [mesh cycles of the frame].
            sums: to be filled.
            repeats: whether each mesh cycle from here on is like the one before.
        """
        found = self._core.MeshSums(damaging=True)
        rate = float(self._core.frame_cycle_rate(self._model.train, self._reached))
        whole = 0
        if repeats and rate != 0.0:
            left = delay(self._reached, time) * abs(rate)
            whole = math.floor(left + ON_EDGE) - SETTLING - 1
        if whole > 0:
            self._repeat(whole, rate, edges, found)
        self._to(time, edges, found)
        sums.damaging, sums.damage, sums.extreme = True, found.damage, found.extreme
        self._core.take_passed(found, sums)

    def _repeat(self, whole: int, rate: float, edges: np.ndarray, found: MeshSums) -> None:
        """Follow pairs in mesh until they leave, then one cycle that counts 1 + `whole` times."""
        period = 1.0 / abs(rate)
        self._to(self._after(SETTLING * period), edges, found)
        cycle = self._core.MeshSums(damaging=True)
        self._to(self._after(period), edges, cycle)
        found.damage = found.damage + (1 + whole) * cycle.damage
        self._core.repeat_passed(cycle, 1 + whole, int(math.copysign(1.0, rate)), found)
        found.extreme = np.maximum(found.extreme, cycle.extreme)
        train, reached = self._model.train, self._reached
        self._core.advance_shafts(self._model, reached, whole * period, reached)
        self._core.skip_cycles(train, int(math.copysign(whole, rate)), self._passages)

    def _to(self, time: Instant, edges: np.ndarray, sums: MeshSums) -> None:
        self._core.follow_passages(
            self._model, self._tolerance, self._reached, self._run, edges, time, self._passages,
            sums,
        )  # fmt: skip

    def _after(self, duration: float) -> Instant:
        """The instant `duration` [s] after the one that is reached."""
        seconds, rest = divmod(float(self._reached.time) + duration, 1.0)
        return Instant(int(self._reached.seconds) + int(seconds), rest)
