"""Whether a finished file is intact, by its checksums."""

from __future__ import annotations

import mmap
import zlib
from pathlib import Path

from mcap.opcode import Opcode

from .framing import piece_at, record_of

MAGIC = b"\x89MCAP0\r\n"
_DATA_END_HEAD = b"\x0f" + (4).to_bytes(8, "little")
_DATA_END = len(_DATA_END_HEAD) + 4  # bytes, with its checksum
_FOOTER = 29  # bytes
_PIECE = 2**24  # bytes read at once


def start_of_summary(file: Path) -> int | None:
    """Position of the summary; None if it fails its checksum, or the file is truncated.

    Without a summary, it is the position of the footer. The checksum zero means that the writer
    computed none.
    """
    return _start_of_summary(file, moved=False)


def end_of_data(file: Path) -> int | None:
    """Position of the Data End record if an intact summary follows it; else None.

    If the file has lost bytes, so that the footer is wrong, the summary is searched.
    """
    start = _start_of_summary(file, moved=True)
    return None if start is None else start - _DATA_END


def damaged_data(file: Path) -> bool:
    """Whether the data before the summary fail their checksum, or the file is not finished.

    This is much faster than decompressing. The checksum zero means that the writer computed none.
    """
    remaining, checksum = end_of_data(file), 0
    if remaining is None:
        return True
    with file.open("rb") as stream:
        while data := stream.read(min(remaining, _PIECE)):
            remaining -= len(data)
            checksum = zlib.crc32(data, checksum)
        end = piece_at(stream)
    return record_of(end.opcode, end.content).data_section_crc not in (0, checksum)


def _start_of_summary(file: Path, moved: bool) -> int | None:
    """Position of an intact summary, which may have `moved` from where the footer says."""
    if file.stat().st_size < len(MAGIC) + _FOOTER:  # an empty file cannot be mapped
        return None
    with file.open("rb") as stream, mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ) as data:
        place = len(data) - len(MAGIC) - _FOOTER
        end = place + _FOOTER
        if data[end:] != MAGIC or data[place] != Opcode.FOOTER:
            return None
        footer = record_of(Opcode.FOOTER, data[place + 9 : end])
        stated = footer.summary_start or place
        found = data.rfind(_DATA_END_HEAD, 0, place) + _DATA_END if moved else stated
        for start in (stated, found):
            if data[max(start - _DATA_END, 0) : start - 4] != _DATA_END_HEAD or start > place:
                continue
            unknown = footer.summary_crc == 0 and start == stated
            if unknown or footer.summary_crc == zlib.crc32(data[start : end - 4]):
                return start
    return None
