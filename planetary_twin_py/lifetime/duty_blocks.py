"""Blocks of a duty, such as days or missions, whose damage scatters."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .duty_table import Duty
from .remaining_life import Blocks

Array = NDArray[np.float64]
DAY = 86_400.0  # [s]


def blocks_of(duty: Duty, damage: Array, length: float | None) -> tuple[Blocks, tuple[str, ...]]:
    """Cut a duty into blocks.

    Args:
        duty: the duty.
        damage: of its rows, (rows, parts).
        length: of each [s]; None: a day if it has two of them. What is left at the end belongs to
            the last block.

    Returns:
        The blocks, and a line if there is only one, so that their scatter is unknown.

    Raises:
        ValueError: a length is given for a duty without times, or which has not two such blocks.
    """
    if length is None:
        whole = duty.time is None or duty.duration < 2.0 * DAY
        length = duty.duration if whole else DAY
    elif duty.time is None:
        raise ValueError("block: only a duty with the column time has an order")
    elif not 0.0 < length <= 0.5 * duty.duration:
        raise ValueError(
            f"block = {length:g} s: must be above 0 and at most {0.5 * duty.duration:g} s, half of "
            "the duty"
        )
    begin = np.concatenate([[0.0], np.cumsum(duty.held)[:-1]])
    count = max(1, int(duty.duration / length * (1.0 + 1e-9)))
    block = np.minimum((begin / length).astype(np.int64), count - 1)
    held, sums = np.zeros(count), np.zeros((count, damage.shape[1]))
    np.add.at(held, block, duty.held)
    np.add.at(sums, block, damage)
    filled = held > 0.0  # a row may be longer than a block
    blocks = Blocks(held[filled], sums[filled])
    if len(blocks.length) > 1:
        return blocks, ()
    return blocks, (
        "the duty is one block: how much it varies from day to day, or mission to mission, is "
        "unknown and not in the interval of the remaining life",
    )
