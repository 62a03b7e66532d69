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
from mcap.records import Channel, DataEnd, Message, Schema
from mcap.stream_reader import CRCValidationError, StreamReader

from .integrity import MAGIC, damaged_summary

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
    """Every record before the summary, which only repeats; what is not sound is in `remarks`."""
    schemas: set[int] = set()
    channels: set[int] = set()
    strays = 0
    for record in _data(file, remarks):
        if isinstance(record, Schema):
            schemas.add(record.id)
        elif isinstance(record, Channel) and record.schema_id in schemas:
            channels.add(record.id)
        elif isinstance(record, Channel | Message) and _channel(record) not in channels:
            strays += isinstance(record, Message)
            continue
        yield record
    if strays:
        remarks.append(f"{file.name}: {strays} messages are of topics whose description is lost")


def _channel(record: Channel | Message) -> int:
    return record.id if isinstance(record, Channel) else record.channel_id


def _data(file: Path, remarks: list[str]) -> Iterator[Any]:
    """Every record up to the end of the data; those after it are only looked at."""
    with file.open("rb") as stream:
        if stream.read(len(MAGIC)) != MAGIC:
            raise RecordingError(f"{file}: no recording: not an MCAP file")
        stream.seek(0)
        reader = StreamReader(stream, validate_crcs=True, record_size_limit=_LONGEST_RECORD)
        records = reader.records
        sound, ended = 0, False
        while True:
            try:
                record = next(records)
            except StopIteration:
                break
            except UnsupportedCompressionError as missing:
                raise RecordingError(f"{file}: {missing}") from None
            except TORN as reason:
                remarks.append(_torn(file, sound, reason))
                return
            sound = stream.tell()
            ended = ended or isinstance(record, DataEnd)
            if not ended:
                yield record
    if not ended:
        remarks.append(f"{file.name}: the end of its data is not marked; some may be missing")
    elif damaged_summary(file):
        remarks.append(f"{file.name}: its summary is damaged")


def _torn(file: Path, sound: int, reason: Exception) -> str:
    if isinstance(reason, CRCValidationError) and isinstance(reason.record, DataEnd):
        return f"{file.name}: its data fail their checksum: what was read may be wrong or lacking"
    size = file.stat().st_size
    return (
        f"{file.name}: ends torn, the last {size - sound} of {size} bytes "
        f"are not readable ({type(reason).__name__}); everything before is sound"
    )


def _torn_errors() -> tuple[type[Exception], ...]:
    """What a record cut in the middle raises: at its end, in its fields, in its compressed data."""
    errors: tuple[type[Exception], ...] = (
        *(McapError, struct.error, ValueError, EOFError),
        *(MemoryError, OverflowError),  # of a length that cannot be
    )
    try:
        import zstandard
    except ImportError:
        return errors
    return (*errors, zstandard.ZstdError)


TORN = _torn_errors()
