"""Plays recorded readings back to a follower, and notes what it says every second."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from .follower import EncoderFormat, EncoderSamples, Follower, Following, Readings

EVERY = 1.0  # [s] from one note to the next


def play_back(
    follower: Follower, readings: Sequence[Readings], samples: EncoderSamples | None
) -> Iterator[Following]:
    """Feed a follower second by second.

    Args:
        follower: without any readings so far.
        readings: in the order of their arrival.
        samples: of the encoders; None: there are none.

    Returns:
        What is said after each second, and at last after all.

    Raises:
        InputError: readings cannot be those of the gearbox.
    """
    place = 0
    for part in readings:
        for rows, until in _seconds(part):
            columns = {name: values[rows] for name, values in part.columns.items()}
            arrival = None if part.arrival is None else part.arrival[rows]
            follower.add(Readings(part.time[rows], columns, arrival, part.sender))
            if samples is not None and follower.encoders is not None:
                place = _feed(follower, follower.encoders, samples, (place, until))
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
    """Add samples up to a time; return the index of the first one that is left."""
    begin, until = at
    end = begin + int(np.searchsorted(samples.sample[begin:], until / encoders.period))
    follower.add(EncoderSamples(samples.sample[begin:end], samples.counts[begin:end]))
    return end
