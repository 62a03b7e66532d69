"""Whether the end of a finished file is as it was written.

What stands before it is guarded by checksums that whoever reads the records looks at.
"""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

from .records import MAGIC

_FOOTER = struct.Struct("<BQQQI")  # opcode, length, start of summary, of its offsets, checksum


def damaged_summary(file: Path) -> bool:
    """Whether the summary of a finished file fails its checksum (MCAP 0, section Footer)."""
    if file.stat().st_size < _FOOTER.size + len(MAGIC):
        return True
    with file.open("rb") as stream:
        stream.seek(-_FOOTER.size - len(MAGIC), 2)
        begin = stream.tell()
        footer, magic = stream.read(_FOOTER.size), stream.read()
        *_, start, _, expected = _FOOTER.unpack(footer)
        if magic != MAGIC or not 0 < start <= begin:
            return True
        stream.seek(start)
        found = zlib.crc32(stream.read(begin - start) + footer[:-4])
    return found != expected
