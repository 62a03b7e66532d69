"""Reads the vectors of a MAT file as the channels of a table."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from .given_channel import (
    Channel,
    channels_of,
    checked,
    reading,
    stated_rate,
    with_short_names,
)
from .hdf5_file import is_hdf5, read_hdf5


def read_mat(path: Path) -> list[Channel]:
    """Read a MAT file, of version 7.3 as HDF5.

    Returns:
        A channel for each vector, and for each of the short side of a matrix, in the order of the
        file; of a structure, its fields. Scalars and text are no channels, but a scalar `fs`,
        `sample_rate` or `dt` states the sample rate.

    Raises:
        FormatError: the file has another format, no vector, or complex numbers.
        OSError: it cannot be read.
    """
    from scipy.io import loadmat

    if is_hdf5(path):
        return read_hdf5(path)
    with reading("not a MAT file of version 4 to 7.3: "):
        variables = loadmat(path, squeeze_me=True, appendmat=False)
    given = dict(_parts(variables))
    rate = stated_rate({name.rpartition("/")[2]: value for name, value in given.items()})
    found = [
        channel
        for name, array in given.items()
        if isinstance(array, np.ndarray)
        for channel in channels_of(name, array, rate)
    ]
    return with_short_names(checked(found))


def _parts(values: Mapping[str, Any], above: str = "") -> Iterator[tuple[str, Any]]:
    """Variables by name; fields of structures as `structure/field`."""
    for name, value in values.items():
        if isinstance(value, np.ndarray) and value.dtype.names and not value.ndim:
            fields = {field: value[field][()] for field in value.dtype.names}
            yield from _parts(fields, f"{above}{name}/")
        else:
            yield above + name, value
