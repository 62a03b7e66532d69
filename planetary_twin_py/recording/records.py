"""The records of a recording, in file order; needs no ROS.

A recording is an MCAP file, or the bag folder that holds one or several. A file torn by a killed
logger still yields every chunk it completed.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from mcap.exceptions import McapError, UnsupportedCompressionError
from mcap.stream_reader import StreamReader

MAGIC = b"\x89MCAP0\r\n"
# The longest record a sound recording holds is a chunk of a few MiB: a torn length field may
# claim any size, and nothing near memory's size must be allocated for it.
_LONGEST_RECORD = 256 * 2**20


class RecordingError(ValueError):
    """The path is no recording, or not one of this gearbox; the message says why in one line."""


def files_of(path: Path) -> list[Path]:
    """The MCAP files of the recording at `path`, in order; raises `RecordingError` without any."""
    if path.is_dir():
        files = sorted(path.glob("*.mcap"), key=lambda file: (len(file.name), file.name))
        if not files:
            raise RecordingError(f"{path}: no recording: the folder holds no .mcap file")
        return files
    if not path.exists():
        raise RecordingError(f"{path}: no such file or folder")
    return [path]


def records_of(file: Path, remarks: list[str]) -> Iterator[Any]:
    """Every complete record of `file`; a torn end is told in `remarks`."""
    with file.open("rb") as stream:
        if stream.read(len(MAGIC)) != MAGIC:
            raise RecordingError(f"{file}: no recording: not an MCAP file")
        stream.seek(0)
        reader = StreamReader(stream, validate_crcs=True, record_size_limit=_LONGEST_RECORD)
        records = reader.records
        sound = 0
        while True:
            try:
                record = next(records)
            except StopIteration:
                return
            except UnsupportedCompressionError as missing:
                raise RecordingError(f"{file}: {missing}") from None
            except TORN as reason:
                lost = file.stat().st_size - sound
                remarks.append(
                    f"{file.name}: ends torn, the last {lost} of {file.stat().st_size} bytes "
                    f"are not readable ({type(reason).__name__}); everything before is sound"
                )
                return
            sound = stream.tell()
            yield record


def _torn_errors() -> tuple[type[Exception], ...]:
    """What a record cut in the middle raises: at its end, in its fields, in its compressed data."""
    # RuntimeError is what lz4 raises.
    errors: tuple[type[Exception], ...] = (
        McapError, struct.error, ValueError, EOFError, RuntimeError
    )  # fmt: skip
    try:
        import zstandard
    except ImportError:
        return errors
    return (*errors, zstandard.ZstdError)


TORN = _torn_errors()
