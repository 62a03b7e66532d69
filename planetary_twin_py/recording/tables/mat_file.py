"""Reads the vectors of a MAT file as the columns of a table."""

from __future__ import annotations

from typing import BinaryIO

import numpy as np
import pyarrow as pa

from ...text.escaping import one_line

_LONGEST_REASON = 200  # characters


class MatError(ValueError):
    """A file without vectors of one length."""


def read_mat(stream: BinaryIO) -> pa.Table:
    """Read a MAT file of version 4 to 7.2.

    Args:
        stream: contents of the file.

    Returns:
        A column for each vector, in the order of the file. Scalars, matrices, text and structures
        are no columns.

    Raises:
        MatError: the file has another format, no vector, complex numbers, or vectors of several
            lengths.
    """
    from scipy.io import loadmat

    try:
        variables = loadmat(stream.name, squeeze_me=True, appendmat=False)
    except Exception as reason:  # of many kinds, if the file is damaged
        if isinstance(reason, OSError) and reason.errno is not None:  # of the system
            raise
        line = one_line(str(reason) or type(reason).__name__, _LONGEST_REASON)
        raise MatError(f"not a MAT file of version 4 to 7.2 (save -v7): {line}") from None
    columns = {
        name: values
        for name, values in variables.items()
        if isinstance(values, np.ndarray) and values.ndim == 1 and values.dtype.kind in "iufcb"
    }
    if not columns:
        raise MatError("has no vector of numbers")
    first, length = next((name, len(values)) for name, values in columns.items())
    for name, values in columns.items():
        if len(values) != length:
            raise MatError(f"{name}: must be a vector as long as {first}, {length} and not "
                           f"{len(values)}")  # fmt: skip
        if values.dtype.kind == "c":
            raise MatError(f"{name}: must be a vector of real numbers")
    return pa.table({name: np.ascontiguousarray(vector) for name, vector in columns.items()})
