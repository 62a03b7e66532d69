"""Sums of many small terms whose rounding errors are carried, the same however terms are grouped.

Neumaier 1974 (Z. Angew. Math. Mech. 54, 39-51): what an addition rounds off, found exactly after
Knuth 1969 (The Art of Computer Programming 2, 4.2.2), is itself summed. Both sums go term by term,
in order, so a series that is cut anywhere gives the same bits.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


@dataclass
class Sums:
    """Compensated sums of a shape (...).

    Args:
        sum: the sums so far, (...).
        compensation: what they have rounded off, (...).
    """

    sum: Array
    compensation: Array = field(default_factory=lambda: np.zeros(()))

    @classmethod
    def zero(cls, *shape: int) -> Sums:
        """Sums of nothing."""
        return cls(np.zeros(shape), np.zeros(shape))

    @property
    def total(self) -> Array:
        """The sums with what was rounded off, (...)."""
        return np.asarray(self.sum + self.compensation)

    def of(self, place: int) -> Sums:
        """The sums at a place of the first axis, of their own."""
        return Sums(self.sum[place].copy(), self.compensation[place].copy())

    def add(self, terms: ArrayLike) -> None:
        """Add terms in order.

        Args:
            terms: the terms, (n, ...), n of any size.
        """
        values = np.asarray(terms, dtype=np.float64)
        # `accumulate` goes from term to term, unlike `sum`.
        sums = np.add.accumulate(np.concatenate([self.sum[None], values]), axis=0)
        before, after = sums[:-1], sums[1:]
        added = after - before
        lost = (before - (after - added)) + (values - added)
        errors = np.concatenate([self.compensation[None], lost])
        self.sum, self.compensation = (
            after[-1] if len(values) else self.sum,
            np.add.accumulate(errors, axis=0)[-1],
        )


def stacked(each: Sequence[Sums]) -> Sums:
    """Sums of the same shape as one, (n, ...).

    Args:
        each: the sums.
    """
    return Sums(np.stack([one.sum for one in each]), np.stack([one.compensation for one in each]))
