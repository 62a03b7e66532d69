"""Records: named fields in one block of memory, which a compiled kernel reads by one pointer.

A NamedTuple of arrays would be copied, array header by array header, at every call of a kernel
from another; that costs more than the mathematics. Arrays in a record have a fixed room.
"""

from __future__ import annotations

from typing import Any

import numpy as np

REGISTER = 8  # doubles the compiler works on at a time: loops over whole registers run fastest
# Room for 7 planets: planets, sun, ring, carrier, machines and the ground; their meshes.
BODIES = 2 * REGISTER
MESHES = 2 * REGISTER
MACHINES = 3  # two motors and a load
AXES = 2  # rigid motions of the train: one for each motor

REAL, WHOLE, FLAG = "f8", "i8", "?"
SMALL = "i1"  # for arrays of flags, which a compiled kernel cannot have in a record

# mypy sees a record as what it is made of: anything with the fields of its layout.
Record = Any


def layout(**fields: Any) -> np.dtype[Any]:
    """Type of a record; a field is a type or a (type, shape) pair."""
    items = [
        (name, *(kind if isinstance(kind, tuple) else (kind,))) for name, kind in fields.items()
    ]
    return np.dtype((np.record, items), align=True)


def fields_of(constants: type[Any]) -> np.dtype[Any]:
    """Type of a record with the fields of a NamedTuple of floats."""
    return layout(**dict.fromkeys(constants._fields, REAL))


def new_record(kind: np.dtype[Any], /, **values: Any) -> Record:
    """A record of zeros, then with the given fields; an array may be shorter than its room."""
    record = np.zeros(1, kind).view(np.recarray)[0]
    for name, value in values.items():
        if kind[name].shape:
            value = np.asarray(value)
            record[name][tuple(slice(size) for size in value.shape)] = value
        else:
            record[name] = value
    return record
