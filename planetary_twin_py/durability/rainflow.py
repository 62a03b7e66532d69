"""Rainflow cycles of a load history, counted as it arrives.

Four turning points in a row contain a closed cycle if the inner range is within both outer ones
(four-point method; Amzallag et al. 1994, Int. J. Fatigue 16, 287-293). What remains is the residue:
it is carried on, so a history may be cut anywhere. Ranges of the residue count as half cycles, as
in ASTM E1049-85, section 5.4.4.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray


class Cycles(NamedTuple):
    """Counted cycles, in the order in which they close."""

    ranges: NDArray[np.float64]
    """Largest minus smallest value, in the unit of the history, (n,)."""
    counts: NDArray[np.float64]
    """1 for whole cycles, 0.5 for half ones, (n,)."""


class Rainflow:
    """Counts the cycles of a history that arrives in parts of any length."""

    def __init__(self, turns: Iterable[float] = ()) -> None:
        """Continue a history.

        Args:
            turns: turning points of another counter, see `turns`.
        """
        self._turns = list(turns)  # the last one may still move on
        self._closed: list[float] = []  # ranges

    def feed(self, values: ArrayLike) -> None:
        """Count a further part of the history.

        Args:
            values: its next values, (n,).

        Raises:
            ValueError: a value is not finite; nothing is counted.
        """
        part = np.asarray(values, dtype=np.float64).ravel()
        wrong = np.flatnonzero(~np.isfinite(part))
        if len(wrong):
            raise ValueError(f"values[{wrong[0]}] = {part[wrong[0]]}: must be finite")
        for value in _turning_points(part):
            self._go_to(value)

    def _go_to(self, value: float) -> None:
        turns = self._turns
        if turns and value == turns[-1]:
            return
        if len(turns) > 1 and (turns[-1] - turns[-2]) * (value - turns[-1]) > 0.0:
            turns[-1] = value  # the same way on
        else:
            turns.append(value)
        # the last turning point is no end of a cycle until the history turns there
        while len(turns) > 4 and _encloses(*turns[-5:-1]):
            self._close(len(turns) - 4)

    @property
    def turns(self) -> tuple[float, ...]:
        """Turning points that are in no closed cycle yet; with them another counter goes on."""
        return tuple(self._turns)

    def take_closed(self) -> list[float]:
        """Ranges of the cycles that have closed since the last call."""
        ranges, self._closed = self._closed, []
        return ranges

    def _close(self, at: int) -> None:
        first, second = self._turns[at : at + 2]
        self._closed.append(abs(second - first))
        del self._turns[at : at + 2]

    @property
    def residue(self) -> tuple[float, ...]:
        """Turning points that are in no closed cycle yet, with the present end of the history."""
        return tuple(self._ended()._turns)

    @property
    def cycles(self) -> Cycles:
        """All cycles so far: those that are closed, and the ranges of the residue as half ones."""
        ended = self._ended()
        halves = [abs(b - a) for a, b in itertools.pairwise(ended._turns)]
        return _cycles(ended._closed, halves)

    @property
    def repeated(self) -> Cycles:
        """Cycles of one period if the history so far is repeated forever: all are whole ones."""
        ended = self._ended()
        again = Rainflow()
        rest = ended._turns
        for value in (*rest, *rest):
            again._go_to(value)
        again = again._ended()
        return _cycles([*ended._closed, *again._closed], [])

    def _ended(self) -> Rainflow:
        """The same with the present end of the history as a turning point."""
        ended = Rainflow()
        ended._turns, ended._closed = list(self._turns), list(self._closed)
        while len(ended._turns) > 3 and _encloses(*ended._turns[-4:]):
            ended._close(len(ended._turns) - 3)
        return ended


def _encloses(first: float, second: float, third: float, last: float) -> bool:
    """Whether the range between the inner two is within both outer ranges."""
    inner = abs(third - second)
    return inner <= abs(second - first) and inner <= abs(last - third)


def _turning_points(values: NDArray[np.float64]) -> Iterable[float]:
    """Values at which a part turns, with its first and its last one."""
    if len(values) < 3:
        return [float(value) for value in values]
    moves = np.flatnonzero(np.diff(values) != 0.0)
    path = np.concatenate([values[moves], values[-1:]])
    if len(path) < 3:
        return [float(value) for value in path]
    up = np.diff(path) > 0.0
    inner = path[1:-1][up[1:] != up[:-1]]
    return [float(value) for value in (path[0], *inner, path[-1])]


def _cycles(whole: list[float], half: list[float]) -> Cycles:
    counts = np.repeat([1.0, 0.5], [len(whole), len(half)])
    return Cycles(np.array([*whole, *half], dtype=np.float64), counts)
