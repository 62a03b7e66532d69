"""Reads the vectors of a MAT file as the columns of a table."""

from __future__ import annotations

import io
import math
import struct
import zlib
from collections.abc import Iterator
from typing import Any, BinaryIO

import numpy as np
import pyarrow as pa

from ...text.escaping import one_line
from .unpacking import UnpackedTooLargeError, check_unpacked

_LONGEST_REASON = 200  # characters
_HEADER = 128  # bytes at the start of a file of version 5 to 7.2
_ENDIAN = {b"IM": "<", b"MI": ">"}  # last bytes of the header
_COMPRESSED = 15  # type of an element, miCOMPRESSED
_TAG = 8  # bytes of type and size before an element
_HEAD = 4096  # bytes of an array that contain its shape and name
_NUMBER = 8  # bytes: arrays of small integers become numbers in double precision


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
        UnpackedTooLargeError: unpacking would add more than `MOST_ADDED`.
    """
    try:
        variables = _variables(stream)
    except UnpackedTooLargeError:
        raise
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


def _variables(stream: BinaryIO) -> dict[str, Any]:
    """All variables by name, read one by one: each takes memory after its size is checked."""
    from scipy.io import loadmat

    variables: dict[str, Any] = {}
    for part in _parts(stream):
        variables |= loadmat(part, squeeze_me=True)
    return variables


def _parts(stream: BinaryIO) -> Iterator[Any]:  # the types of SciPy allow paths only
    """Uncompressed files of one variable each; a file of version 4, or of 7.3, as it is."""
    header = stream.read(_HEADER)
    endian = _ENDIAN.get(header[-2:])
    if len(header) < _HEADER or endian is None:
        stream.seek(0)
        yield stream
        return
    size = stream.seek(0, io.SEEK_END)
    stream.seek(_HEADER)
    unpacked = float(size)
    while len(tag := stream.read(_TAG)) == _TAG:
        kind, length = struct.unpack(f"{endian}II", tag)
        body = stream.read(min(length, size))
        if kind == _COMPRESSED:
            unpack = zlib.decompressobj()
            element = unpack.decompress(body, _HEAD)
            unpacked += _growth(header, element, length, endian)
            check_unpacked(size, unpacked)
            missing = struct.unpack(f"{endian}I", element[4:_TAG])[0] + _TAG - len(element)
            if missing > 0:
                element += unpack.decompress(unpack.unconsumed_tail, missing)
        else:
            element = tag + body
            unpacked += _growth(header, element[:_HEAD], _TAG + length, endian)
            check_unpacked(size, unpacked)
        yield io.BytesIO(header + element)


def _growth(header: bytes, head: bytes, packed: int, endian: str) -> float:
    """Bytes that an array takes beyond those in the file, from its first bytes."""
    from scipy.io import whosmat

    file: Any = io.BytesIO(header + head)
    stated = _TAG + struct.unpack(f"{endian}I", head[4:_TAG])[0]
    numbers = sum(math.prod(shape) for _, shape, kind in whosmat(file) if kind != "sparse")
    return float(max(stated, _NUMBER * numbers) - packed)
