"""Time until a part fails, as an interval: strengths scatter, and so does a duty."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .reliability import Scatter

Array = NDArray[np.float64]

DRAWS = 20_000
PERCENTILES = 2.5, 50.0, 97.5


class Blocks(NamedTuple):
    """A duty in blocks, such as days, which vary and may come in any order."""

    length: Array
    """[s], (blocks,)."""
    damage: Array
    """Miner sums of each block, (blocks, parts)."""


class RemainingLife(NamedTuple):
    """Time until the first part fails."""

    low: float
    """Time that 2.5 % of such gearboxes do not reach [s]."""
    median: float
    """That half of them do not reach [s]."""
    high: float
    """That 97.5 % do not reach [s]."""
    material_share: float
    """Part of the variance of the logarithm of the time that comes from the scatter of strengths;
    the rest comes from the duty. NaN if the duty is one block, so that its scatter is unknown."""
    blocks: int
    """Blocks of the duty."""


def remaining_life(
    blocks: Blocks, scatter: Sequence[Scatter], reached: Array, seed: int = 0
) -> RemainingLife:
    """Time until the first part fails, if the duty goes on with blocks like these.

    The damage at which each part fails is drawn from its Weibull distribution, given that it has
    survived so far. The mean rate of damage until then is that of blocks drawn with replacement: as
    many as have the variance of a mean over the future blocks with a mean that is only known from
    the given ones.

    Args:
        blocks: of the duty.
        scatter: of each part, (parts,).
        reached: Miner sums so far, (parts,).
        seed: of the random numbers.

    Returns:
        The interval; infinite if no part is damaged.
    """
    mean = blocks.damage.sum(axis=0) / blocks.length.sum()
    ageing = [int(part) for part in np.flatnonzero(mean > 0.0)]
    count = len(blocks.length)
    if not ageing:
        return RemainingLife(math.inf, math.inf, math.inf, math.nan, count)
    chance = np.random.default_rng(seed)
    weibulls = [scatter[part].weibull() for part in ageing]
    draws = chance.random((DRAWS, len(ageing)))
    left = np.column_stack(
        [
            weibull.beyond(float(reached[part]), draws[:, n]) - reached[part]
            for n, (weibull, part) in enumerate(zip(weibulls, ageing, strict=True))
        ]
    )
    middle = np.array(
        [
            float(weibull.beyond(float(reached[part]), 0.5)) - reached[part]
            for weibull, part in zip(weibulls, ageing, strict=True)
        ]
    )
    usual = float((middle / mean[ageing]).min()) / float(blocks.length.mean())
    drawn = max(1, round(count * usual / (count + usual)))
    picks = chance.integers(count, size=(DRAWS, drawn))
    rates = _rates(blocks, picks, ageing)
    lives = (left / rates).min(axis=1)
    low, median, high = (float(value) for value in np.percentile(lives, PERCENTILES))
    material = _spread((left / mean[ageing]).min(axis=1))
    duty = _spread((middle / rates).min(axis=1))
    share = material / (material + duty) if count > 1 and material + duty > 0.0 else math.nan
    return RemainingLife(low, median, high, share, count)


def _rates(blocks: Blocks, picks: NDArray[np.int64], ageing: list[int]) -> Array:
    """Mean rates of picked blocks [1/s], (draws, parts)."""
    length = blocks.length[picks].sum(axis=1)
    damage = blocks.damage[:, ageing]
    sums = np.column_stack([damage[:, n][picks].sum(axis=1) for n in range(len(ageing))])
    with np.errstate(divide="ignore"):
        return np.asarray(np.maximum(sums / length[:, np.newaxis], np.finfo(float).tiny))


def _spread(lives: Array) -> float:
    return float(np.var(np.log(np.maximum(lives, np.finfo(float).tiny))))
