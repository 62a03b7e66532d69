"""Integrity of a finished file, by its checksums."""

from __future__ import annotations

import mmap
import struct
import zlib
from pathlib import Path

MAGIC = b"\x89MCAP0\r\n"
_DATA_END = struct.Struct("<BQI")  # opcode, length, checksum
_DATA_END_HEAD = struct.pack("<BQ", 15, 4)
_CHECKSUM = 4  # bytes
_PIECE = 2**24  # bytes read at once
_FOOTER = struct.Struct("<BQQQI")  # opcode, length, start of summary, of its offsets, checksum


def damaged_summary(file: Path) -> bool:
    """Whether the summary fails its checksum (MCAP 0, section Footer), or the file is truncated.

    The checksum zero means that the writer computed none.
    """
    with file.open("rb") as stream:
        begin = stream.seek(0, 2) - _FOOTER.size - len(MAGIC)
        if begin < 0:
            return True
        stream.seek(begin)
        footer, magic = stream.read(_FOOTER.size), stream.read()
        *_, start, _, expected = _FOOTER.unpack(footer)
        if magic != MAGIC or not 0 <= start <= begin:
            return True
        stream.seek(start or begin)  # zero: there is no summary
        checksum = zlib.crc32(stream.read(begin - (start or begin)) + footer[:-4])
    return expected not in (0, checksum)


def start_of_summary(file: Path) -> int:
    """Position of the summary in a file that is not truncated; that of the footer without one."""
    with file.open("rb") as stream:
        footer = stream.seek(-_FOOTER.size - len(MAGIC), 2)
        *_, start, _, _ = _FOOTER.unpack(stream.read(_FOOTER.size))
    return int(start) or footer


def damaged_data(file: Path) -> bool:
    """Whether the data before the summary fail their checksum (MCAP 0, section Data End).

    This is much faster than decompressing. The checksum zero means that the writer computed none.
    """
    with file.open("rb") as stream:
        stream.seek(-_FOOTER.size - len(MAGIC), 2)
        _, _, summary, _, _ = _FOOTER.unpack(stream.read(_FOOTER.size))
        if summary < _DATA_END.size:
            return True
        remaining, checksum = summary - _DATA_END.size, 0
        stream.seek(0)
        while remaining:
            piece = stream.read(min(remaining, _PIECE))
            if not piece:
                return True
            remaining -= len(piece)
            checksum = zlib.crc32(piece, checksum)
        _, _, expected = _DATA_END.unpack(stream.read(_DATA_END.size))
    return expected not in (0, checksum)


def end_of_data(file: Path) -> int | None:
    """Position of the Data End record if an intact summary follows it; else None.

    It follows from the footer or, in a file that has lost bytes, from the summary's checksum.
    """
    if file.stat().st_size == 0:  # which cannot be mapped
        return None
    with file.open("rb") as stream, mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ) as data:
        footer = len(data) - _FOOTER.size - len(MAGIC)
        if footer < _DATA_END.size or data[footer + _FOOTER.size :] != MAGIC:
            return None
        *_, start, _, expected = _FOOTER.unpack_from(data, footer)
        for place in (start - _DATA_END.size, data.rfind(_DATA_END_HEAD, 0, footer)):
            summary = place + _DATA_END.size
            if place < 0 or summary > footer or data[place:summary][:9] != _DATA_END_HEAD:
                continue
            checksum = zlib.crc32(data[summary : footer + _FOOTER.size - _CHECKSUM])
            if checksum == expected or (expected == 0 and summary == start):
                return int(place)
    return None
