"""Rainflow cycles of a load history, counted as it arrives.

Four turning points in a row contain a closed cycle if the inner range is within both outer ones
(four-point method; Amzallag et al. 1994, Int. J. Fatigue 16, 287-293). What remains is the residue:
it is carried on, so a history may be cut anywhere. Ranges of the residue count as half cycles, as
in ASTM E1049-85, section 5.4.4.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..text.number_check import check_number


class Cycles(NamedTuple):
    """Counted cycles, in the order in which they close."""

    ranges: NDArray[np.float64]
    """Largest minus smallest value, in the unit of the history, (n,)."""
    means: NDArray[np.float64]
    """Mean of these two, (n,)."""
    counts: NDArray[np.float64]
    """1 for whole cycles, 0.5 for half ones, (n,)."""

    def equivalent_range(self, exponent: float, cycles: float) -> float:
        """Range of constant cycles that do the same damage.

        Args:
            exponent: negative slope of the S-N curve, above 0.
            cycles: their number, above 0.

        Returns:
            (sum n_i r_i^m / cycles)^(1/m), in the unit of the history (Hayman 2012, NREL).

        Raises:
            ValueError: an argument is not above 0.
        """
        for name, value in (("exponent", exponent), ("cycles", cycles)):
            check_number(name, value, "")
            if not value > 0.0:
                raise ValueError(f"{name} = {value!r}: must be above 0")
        if not len(self.ranges):
            return 0.0
        largest = float(self.ranges.max())  # powers of the ranges themselves might overflow
        shares = self.counts * (self.ranges / largest) ** exponent
        return largest * float((math.fsum(shares) / cycles) ** (1.0 / exponent))


class Rainflow:
    """Counts the cycles of a history that arrives in parts of any length."""

    def __init__(self, turns: Iterable[float] = ()) -> None:
        """Continue a history.

        Args:
            turns: turning points of another counter, see `turns`.
        """
        self._turns = list(turns)  # the last one may still move on
        self._closed: list[tuple[float, float]] = []  # range, mean

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
        """Ranges of the cycles that have closed since the last call, which it forgets."""
        ranges = [size for size, _ in self._closed]
        self._closed.clear()
        return ranges

    def _close(self, at: int) -> None:
        first, second = self._turns[at : at + 2]
        self._closed.append((abs(second - first), 0.5 * (first + second)))
        del self._turns[at : at + 2]

    @property
    def residue(self) -> tuple[float, ...]:
        """Turning points that are in no closed cycle yet, with the present end of the history."""
        return tuple(self._ended()._turns)

    @property
    def cycles(self) -> Cycles:
        """All cycles so far: those that are closed, and the ranges of the residue as half ones."""
        ended = self._ended()
        rest = ended._turns
        halves = [(abs(b - a), 0.5 * (a + b)) for a, b in itertools.pairwise(rest)]
        return _cycles(ended._closed, halves)

    @property
    def repeated(self) -> Cycles:
        """Cycles of one period if the history so far is repeated for ever: all are whole ones."""
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


def _cycles(whole: list[tuple[float, float]], half: list[tuple[float, float]]) -> Cycles:
    both = np.array([*whole, *half], dtype=np.float64).reshape(-1, 2)
    counts = np.repeat([1.0, 0.5], [len(whole), len(half)])
    return Cycles(both[:, 0], both[:, 1], counts)
