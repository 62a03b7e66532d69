"""Whether the end of a finished file is as it was written.

What stands before it is guarded by checksums that whoever reads the records looks at.
"""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

MAGIC = b"\x89MCAP0\r\n"
_FOOTER = struct.Struct("<BQQQI")  # opcode, length, start of summary, of its offsets, checksum


def damaged_summary(file: Path) -> bool:
    """Whether the summary fails its checksum (MCAP 0, section Footer), or the file is torn.

    A writer that computes none says so with the checksum zero.
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
        found = zlib.crc32(stream.read(begin - (start or begin)) + footer[:-4])
    return expected not in (0, found)
