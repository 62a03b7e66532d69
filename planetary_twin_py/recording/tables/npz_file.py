"""Reads the arrays of a NumPy archive of another program, or of `export`."""

from __future__ import annotations

from pathlib import Path
from zipfile import BadZipFile

import numpy as np

from .given_channel import Channel, FormatError, channels_of, checked, stated_rate

OF_RUN = frozenset({"bodies", "meshes", "time"})
"""Arrays of the samples of a run, as `simulate --out` writes them."""


def is_of_others(path: Path) -> bool:
    """Whether a file is an archive without the samples of a run; false if it cannot be read."""
    try:
        with np.load(path, allow_pickle=False) as archive:
            return not set(archive.files) >= OF_RUN
    except (BadZipFile, ValueError, OSError, EOFError, AttributeError):
        return False


def read_npz(path: Path) -> list[Channel]:
    """Read the vectors and matrices of numbers of a NumPy archive.

    A sample rate is a number `sample_rate`, `fs` or `dt`. The arrays `columns` and `units` of
    `export` state units.

    Raises:
        FormatError: the file is damaged or has no vector of numbers.
        OSError: it cannot be read.
    """
    try:
        with np.load(path, allow_pickle=False) as archive:
            arrays = {name: archive[name] for name in archive.files}
    except FileNotFoundError:
        raise
    except (BadZipFile, ValueError, OSError, EOFError, AttributeError) as reason:
        raise FormatError(f"not a whole archive of numbers: {reason}") from None
    rate = stated_rate({name: one for name, one in arrays.items() if one.size == 1})
    named = zip(arrays.get("columns", ()), arrays.get("units", ()), strict=False)
    units = {str(name): str(unit) for name, unit in named}
    found = [
        channel
        for name, one in arrays.items()
        for channel in channels_of(name, one, rate, units.get(name) or None)
    ]
    return checked(found)
