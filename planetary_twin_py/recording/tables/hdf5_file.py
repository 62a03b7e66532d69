"""Reads the channels of an HDF5 file, also of one that MATLAB writes (version 7.3)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from .given_channel import (
    Channel,
    channels_of,
    checked,
    missing_package,
    reading,
    stated_rate,
    with_short_names,
)

SIGNATURE = b"\x89HDF\r\n\x1a\n"
_PLACES = (0, 512, 1024, 2048)  # of the signature, behind the header of another program
_UNITS = ("unit", "units", "unit_string", "Unit", "Units", "UNIT")


def is_hdf5(path: Path) -> bool:
    """Whether the contents of a file are HDF5."""
    with path.open("rb") as stream:
        head = stream.read(_PLACES[-1] + len(SIGNATURE))
    return any(head[place : place + len(SIGNATURE)] == SIGNATURE for place in _PLACES)


def read_hdf5(path: Path) -> list[Channel]:
    """Read the vectors and matrices of numbers of an HDF5 file.

    A sample rate is an attribute `sample_rate`, `fs` or `dt` of a data set, of a group above it,
    or a number of that name beside it. A unit is the attribute `unit` or `units`.

    Returns:
        A channel for each vector, by the last part of its path where that is unique.

    Raises:
        FormatError: h5py is missing, or the file is damaged or has no vector of numbers.
        OSError: it cannot be read.
    """
    try:
        import h5py
    except ImportError:
        raise missing_package("h5py") from None
    path.open("rb").close()  # h5py gives no reason that a reader would know
    with reading("not a whole HDF5 file: "), h5py.File(path, "r") as file:
        found = _channels(file, "", None, h5py)
    return with_short_names(checked(found))


def _channels(group: Any, above: str, rate: float | None, h5py: Any) -> list[Channel]:
    """The channels of a group and of those in it.

    Args:
        group: of the file.
        above: its path, with a slash at the end unless it is empty.
        rate: sample rate that a group above states [Hz].
        h5py: the package.
    """
    sets = {name: one for name, one in group.items() if isinstance(one, h5py.Dataset)}
    numbers = {name: one[()] for name, one in sets.items() if one.size == 1}
    rate = stated_rate(dict(group.attrs)) or stated_rate(numbers) or rate
    found = list[Channel]()
    for name, one in sets.items():
        if one.attrs.get("MATLAB_class") == b"char" or one.dtype.kind not in "iufcbV":
            continue
        own = stated_rate(dict(one.attrs)) or rate
        found += channels_of(f"{above}{name}", np.asarray(one[()]), own, _unit(one.attrs))
    for name, inner in group.items():
        if isinstance(inner, h5py.Group) and name != "#refs#":
            found += _channels(inner, f"{above}{name}/", rate, h5py)
    return found


def _unit(attributes: Any) -> str | None:
    for name in _UNITS:
        text = attributes.get(name)
        if isinstance(text, bytes):
            text = text.decode(errors="replace")
        if isinstance(text, str) and text.strip():
            return text.strip()
    return None
