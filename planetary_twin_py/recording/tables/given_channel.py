"""Channels of a file as it holds them: names, units, samples, and sample rates that it states."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...text.escaping import one_line

Array = NDArray[np.float64]

MOST_CHANNELS = 64  # rows or columns of a matrix that are channels
LONG = 8  # times the number of channels: samples in a matrix, which otherwise is a table of numbers
_LONGEST_REASON = 200  # characters
_RATE = re.compile(r"(?i)(?:fs|(?:sample|sampling)_?(?:rate|frequency)(?:_hz)?)")
_STEP = re.compile(r"(?i)(?:dt|(?:sample|sampling)_?(?:period|interval)(?:_s)?|wf_increment)")


class Channel(NamedTuple):
    """Samples of one channel."""

    heading: str
    values: NDArray[Any]
    """(n,)."""
    unit: str | None = None
    """None if the file states none."""
    time: Array | None = None
    """Of each sample [s], (n,); None if the file states neither times nor a sample rate."""
    remarks: tuple[str, ...] = ()
    """What is doubtful about the file."""


class FormatError(ValueError):
    """A file that is not of the format that its name states, or without a channel."""


def missing_package(package: str) -> FormatError:
    """The error that a package which reads this format is not installed."""
    return FormatError(f"needs {package}: pip install 'planetary_twin_py[measured]'")


@contextmanager
def reading(wrong: str = "") -> Iterator[None]:
    """Context in which any error of the package that reads a file becomes a `FormatError`.

    Args:
        wrong: what is wrong, such as "not a whole TDMS file: ", before the reason.
    """
    try:
        yield
    except FormatError:
        raise
    except Exception as reason:  # of many kinds, if the file is damaged
        text = one_line(str(reason) or type(reason).__name__, _LONGEST_REASON)
        raise FormatError(f"{wrong}{text}") from None


def times(number: int, rate: float, begin: float = 0.0) -> Array:
    """Times of samples at equal steps [s], (number,).

    Args:
        number: of samples.
        rate: sample rate [Hz].
        begin: time of the first sample [s].
    """
    return begin + np.arange(number) / rate


def stated_rate(values: Mapping[str, Any]) -> float | None:
    """Sample rate [Hz] in named numbers, such as `fs`, `sample_rate` or `dt`; None without.

    Args:
        values: numbers and other things by name.
    """
    for name, value in values.items():
        whole_rate, whole_step = (one.fullmatch(name) for one in (_RATE, _STEP))
        if not (whole_rate or whole_step):
            continue
        number = np.asarray(value)
        if number.size != 1 or number.dtype.kind not in "iuf":
            continue
        found = float(number.reshape(()))
        if not 0.0 < found < np.inf:
            raise FormatError(f"{name} = {found:g}: must be above 0")
        return found if whole_rate else 1.0 / found
    return None


def channels_of(
    name: str, values: NDArray[Any], rate: float | None, unit: str | None = None
) -> Iterator[Channel]:
    """The channels in an array: a vector, the short side of a matrix, or the fields of records.

    Args:
        name: of the array; channels of a matrix are `name_1`, `name_2`, ....
        values: any array; text and numbers alone are no channels.
        rate: sample rate [Hz]; None if the file states none.
        unit: None if the file states none.
    """
    for heading, vector in _vectors(name, values):
        yield Channel(heading, vector, unit, None if rate is None else times(len(vector), rate))


def checked(found: list[Channel]) -> list[Channel]:
    """The channels of a file.

    Raises:
        FormatError: there are none.
    """
    if not found:
        raise FormatError("has no vector of numbers")
    return found


def _vectors(name: str, values: NDArray[Any]) -> Iterator[tuple[str, NDArray[Any]]]:
    if values.dtype.names:
        for field in values.dtype.names:
            yield from _vectors(f"{name}/{field}", values[field])
        return
    if values.dtype.kind not in "iufcb" or values.size < 2:
        return
    if values.dtype.kind == "c":
        raise FormatError(f"{name}: must be a vector of real numbers")
    values = np.squeeze(values)
    if values.ndim == 1:
        yield name, values
    elif values.ndim == 2 and min(values.shape) <= min(MOST_CHANNELS, max(values.shape) // LONG):
        rows = values if values.shape[0] < values.shape[1] else values.T
        for number, row in enumerate(rows, 1):
            yield f"{name}_{number}", row


def with_short_names(channels: list[Channel]) -> list[Channel]:
    """Channels by the last part of their name after a slash, where that is unique.

    Args:
        channels: with names such as `group/name`.
    """
    last = [channel.heading.rpartition("/")[2] for channel in channels]
    return [
        channel._replace(heading=short) if last.count(short) == 1 else channel
        for channel, short in zip(channels, last, strict=True)
    ]
