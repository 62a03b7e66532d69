"""Random numbers of a data set: each from its place alone, never from the order of work."""

from __future__ import annotations

import zlib
from enum import IntEnum
from typing import Any

import numpy as np

from ..scene import Scene
from ..studies.axes import Axis, Normal, Span, read_axis, read_value


class Place(IntEnum):
    """What random numbers are for; the first number of their seeds after that of the data set."""

    SPECIMEN = 1
    STATE = 2
    POINT = 3
    COURSE = 4
    SENSOR = 5
    SPLIT = 6
    RUN = 7


def chance(seed: int, place: Place, *numbers: int, name: str = "") -> np.random.Generator:
    """Random numbers for one place of a data set.

    Args:
        seed: of the data set.
        place: what they are for.
        numbers: of specimen, state, point and repetition, as far as they depend on them.
        name: of the quantity, so that another one beside it changes nothing.
    """
    return np.random.default_rng([seed, int(place), *numbers, zlib.crc32(name.encode())])


def is_distribution(given: Any) -> bool:
    """Whether a value of a specification is a text with several values, a range or a law."""
    return isinstance(given, str) and (":" in given or "," in given or given.startswith("normal("))


def first_value(given: Any) -> Any:
    """A value of a distribution, with its unit; other values as they are."""
    if not is_distribution(given):
        return given
    return given.removeprefix("normal(").replace(":", ",").split(",")[0].strip()


def read_draw(scene: Scene, field: str, given: Any) -> Axis | Span | Normal:
    """The values of a field that records may have.

    Args:
        scene: has the field.
        field: dotted name.
        given: a value, or a text as `sweep` takes it.

    Returns:
        The values, the range or the distribution.

    Raises:
        ValueError: see `read_axis`.
    """
    if is_distribution(given):
        return read_axis(scene, field, given)
    return Axis(field, (read_value(scene, field, given),))


def value_at(draw: Axis | Span | Normal, share: float) -> Any:
    """The value below which a share of a distribution lies.

    Args:
        draw: the distribution; the whole numbers of a range are equally frequent.
        share: from 0 to below 1.

    Returns:
        The value in SI.
    """
    if isinstance(draw, Axis):
        return draw.values[int(share * len(draw.values))]
    if isinstance(draw, Span) and isinstance(draw.low, int):
        return draw.low + int(share * (draw.high - draw.low + 1))
    return float(draw.at(np.array([share]))[0])
