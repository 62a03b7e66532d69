"""Fields in a file of baselines, each with the type and the shape of its values."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .hunting_blocks import BINS

NUMBER, WHOLE, TRUTH, TEXT = "fi", "iu", "b", "U"  # kinds of numpy types


class Field(NamedTuple):
    """A value of a cell."""

    kinds: str
    """Allowed kinds of its type."""
    shape: tuple[str | int, ...] = ()
    """Length of each axis, or what it counts."""
    finite: bool = True
    """Whether NaN and infinity are refused."""


_MAP = ("cycles", BINS)
_AMPLITUDES = ("periods", "channels", "patterns")
FIELDS = {
    "teeth": {
        "torque": Field(NUMBER),
        "speed": Field(NUMBER),
        "needed": Field(WHOLE),
        "mean": Field(NUMBER, _MAP),
        "sd": Field(NUMBER, ("gears",)),
        "known": Field(TRUTH, _MAP),
        "taken_off": Field(TRUTH),
        "digest": Field(TEXT),
        "_centre": Field(NUMBER),
        "_spread": Field(NUMBER),
        "slope": Field(NUMBER, _MAP),
    },
    "vibration": {
        "torque": Field(NUMBER),
        "speed": Field(NUMBER),
        "highest": Field(NUMBER),
        "begin": Field(NUMBER, ("periods",)),
        "found": Field(NUMBER, _AMPLITUDES, finite=False),
        "floor": Field(NUMBER, _AMPLITUDES, finite=False),
        "each_torque": Field(NUMBER, ("periods",)),
        "each_speed": Field(NUMBER, ("periods",)),
    },
}
"""Fields by the kind of a baseline and by name."""


BLOCKS = Field(NUMBER, ("blocks", 3))
"""Torque, speed and mean transmission error of the first hunting periods."""


def check_cell(
    where: str, kind: str, cell: Mapping[str, NDArray[Any]], sizes: Mapping[str, int]
) -> None:
    """Check the fields of a cell of "teeth" or "vibration"; `where` is named in the message.

    `sizes` are known lengths of axes by what they count; the others must agree within the cell.
    """
    known = dict(sizes)
    for name, field in FIELDS[kind].items():
        check_field(f"{where}/{name}", field, cell.get(name), known)


def check_field(
    where: str, field: Field, value: NDArray[Any] | None, known: dict[str, int]
) -> None:
    """Raise `ValueError` if a value is missing, or has another type or shape; names the field.

    Lengths of its axes are added to those known by what they count.
    """
    if value is None:
        raise ValueError(f"{where}: missing")
    if value.dtype.kind not in field.kinds:
        raise ValueError(f"{where}: has values of type {value.dtype}")
    for count, length in zip(field.shape, value.shape, strict=False):
        known.setdefault(str(count), length if isinstance(count, str) else count)
    expected = tuple(known.get(str(count), count) for count in field.shape)
    if value.shape != expected:
        raise ValueError(f"{where}: has the shape {value.shape}: must be {expected}")
    if field.finite and value.dtype.kind == "f" and not np.isfinite(value).all():
        raise ValueError(f"{where}: must be finite")
