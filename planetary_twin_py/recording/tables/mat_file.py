"""Reads the vectors of a MAT file as the channels of a table."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...text.escaping import one_line
from .given_channel import Channel, FormatError, stated_rate, times, vectors_of
from .hdf5_file import is_hdf5, read_hdf5

_LONGEST_REASON = 200  # characters


def read_mat(path: Path) -> list[Channel]:
    """Read a MAT file, of version 7.3 as HDF5.

    Returns:
        A channel for each vector, and for each of the short side of a matrix, in the order of the
        file. Scalars, text and structures are no channels, but a scalar `fs`, `sample_rate` or `dt`
        states the sample rate.

    Raises:
        FormatError: the file has another format, no vector, or complex numbers.
        OSError: it cannot be read.
    """
    from scipy.io import loadmat

    if is_hdf5(path):
        return read_hdf5(path)
    try:
        variables = loadmat(path, squeeze_me=True, appendmat=False)
    except Exception as reason:  # of many kinds, if the file is damaged
        if isinstance(reason, OSError) and reason.errno is not None:  # of the system
            raise
        line = one_line(str(reason) or type(reason).__name__, _LONGEST_REASON)
        raise FormatError(f"not a MAT file of version 4 to 7.3: {line}") from None
    rate = stated_rate(variables)
    found = [
        Channel(heading, values, time=None if rate is None else times(len(values), rate))
        for name, array in variables.items()
        if isinstance(array, np.ndarray) and not array.dtype.names
        for heading, values in vectors_of(name, array)
    ]
    if not found:
        raise FormatError("has no vector of numbers")
    return found
