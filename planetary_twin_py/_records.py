"""Records: named fields in one block of memory, which a compiled kernel reads by one pointer.

A NamedTuple of arrays would be copied, array header by array header, at every call of a kernel
from another; that costs more than the mathematics. Arrays in a record have a fixed room.
"""

from __future__ import annotations

from typing import Any

import numpy as np

REGISTER = 4  # doubles the compiler works on at a time: loops over whole registers run fastest
# Room for 7 planets: planets, sun, ring, carrier, machines and the ground; their meshes.
BODIES = 4 * REGISTER
MESHES = 4 * REGISTER
MACHINES = 3  # two motors and a load
AXES = 2  # rigid motions of the train: one for each motor

REAL, WHOLE, FLAG = "f8", "i8", "?"
SMALL = "i1"  # for arrays of flags, which a compiled kernel cannot have in a record

# mypy sees a record as what it is made of: anything with the fields of its layout.
Record = Any


CACHE_LINE = 64  # [bytes] vector registers that straddle two lines take twice as long to load


def layout(**fields: Any) -> np.dtype[Any]:
    """Type of a record; a field is a type or a (type, shape) pair.

    What fills a cache line begins with one.
    """
    formats = [np.dtype(kind) for kind in fields.values()]
    offsets, end = [], 0
    for kind in formats:
        line = CACHE_LINE if kind.itemsize >= CACHE_LINE else max(kind.alignment, 1)
        offsets.append(-(-end // line) * line)
        end = offsets[-1] + kind.itemsize
    size = -(-end // CACHE_LINE) * CACHE_LINE
    table: Any = {"names": list(fields), "formats": formats, "offsets": offsets, "itemsize": size}
    # The type of its scalars goes on last: with it numpy would ignore `align`.
    return np.dtype((np.record, np.dtype(table, align=True)))


def fields_of(constants: type[Any]) -> np.dtype[Any]:
    """Type of a record with the fields of a NamedTuple of floats."""
    return layout(**dict.fromkeys(constants._fields, REAL))


def new_record(kind: np.dtype[Any], /, **values: Any) -> Record:
    """A record of zeros, then with the given fields; an array may be shorter than its room."""
    room = np.zeros(kind.itemsize + CACHE_LINE, np.uint8)
    start = -room.ctypes.data % CACHE_LINE
    record = room[start : start + kind.itemsize].view(kind).view(np.recarray)[0]
    for name, value in values.items():
        if kind[name].shape:
            value = np.asarray(value)
            record[name][tuple(slice(size) for size in value.shape)] = value
        else:
            record[name] = value
    return record
