"""Reads the vectors of a MAT file as the channels of a table."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .given_channel import Channel, channels_of, checked, reading, stated_rate
from .hdf5_file import is_hdf5, read_hdf5


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
    with reading("not a MAT file of version 4 to 7.3: "):
        variables = loadmat(path, squeeze_me=True, appendmat=False)
    rate = stated_rate(variables)
    found = [
        channel
        for name, array in variables.items()
        if isinstance(array, np.ndarray) and not array.dtype.names
        for channel in channels_of(name, array, rate)
    ]
    return checked(found)
