"""Passes recorded readings to a follower, and returns the estimated state of every second."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from .follower import EncoderFormat, EncoderSamples, Follower, Following, Readings
from .measured_messages import Block

EVERY = 1.0  # [s] between two estimated states


def play_back(
    follower: Follower,
    blocks: Sequence[Block],
    samples: EncoderSamples | None,
) -> Iterator[Following]:
    """Pass readings to a follower second by second.

    Args:
        follower: follower without readings.
        blocks: readings in the order of their arrival.
        samples: encoder samples, which are merged with the readings by time; None: there are none,
            or they are among the blocks.

    Returns:
        The estimated state after each second, and after the last reading.

    Raises:
        InputError: readings contradict the scene.
    """
    place, noted = 0, -math.inf
    for block in blocks:
        if not isinstance(block, Readings):
            follower.add(block)
            continue
        for rows, until in _seconds(block):
            columns = {name: values[rows] for name, values in block.columns.items()}
            arrival = None if block.arrival is None else block.arrival[rows]
            follower.add(Readings(block.time[rows], columns, arrival, block.sender))
            if samples is not None and follower.encoders is not None:
                place = _feed(follower, follower.encoders, samples, (place, until))
            if follower.time > noted + EVERY - 0.5 * follower.period:
                noted = follower.time
                yield follower.estimate()
    if samples is not None:
        follower.add(EncoderSamples(samples.sample[place:], samples.counts[place:]))
    follower.finish()
    yield follower.estimate()


def _seconds(part: Readings) -> Iterator[tuple[slice, float]]:
    """Rows of each second, and the time at which it ends."""
    time = np.maximum.accumulate(np.where(np.isfinite(part.time), part.time, -np.inf))
    begin = 0
    while begin < len(time):
        start = time[begin] if np.isfinite(time[begin]) else 0.0
        until = float(start + EVERY)
        end = max(int(np.searchsorted(time, until)), begin + 1)
        yield slice(begin, end), until
        begin = end


def _feed(
    follower: Follower, encoders: EncoderFormat, samples: EncoderSamples, at: tuple[int, float]
) -> int:
    """Add samples up to a time; return the index of the first one after it."""
    begin, until = at
    end = begin + int(np.searchsorted(samples.sample[begin:], until / encoders.period))
    follower.add(EncoderSamples(samples.sample[begin:end], samples.counts[begin:end]))
    return end
