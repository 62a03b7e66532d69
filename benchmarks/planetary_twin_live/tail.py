"""Follows a recording while another process writes it: number and age of messages in the file."""

from __future__ import annotations

import struct
import threading
import time
from pathlib import Path
from typing import BinaryIO, Self

_MAGIC_SIZE = 8
_RECORD = struct.Struct("<BQ")  # opcode, length
_CHUNK = struct.Struct("<QQ")  # log time of the first message, and of the last [ns]
_INDEX = struct.Struct("<HI")  # channel, bytes of its entries
_CHUNK_CODE, _INDEX_CODE = 0x06, 0x07
_ENTRY = 16  # bytes of a message's entry in an index
_POLL = 2e-3  # [s]


class Tail:
    """Reads the chunks of `file` as they appear, in a separate thread."""

    def __init__(self, file: Path) -> None:
        self.messages = 0
        self.latencies: list[float] = []
        """Age of the oldest message of each chunk when the chunk is complete in the file [s]."""
        self.newest = 0.0
        """Monotonic time at which the last chunk appeared [s]."""
        self._file = file
        self._place = _MAGIC_SIZE
        self._chunk = 0
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._follow, name="tail")

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(self, *raised: object) -> None:
        self._over.set()
        self._thread.join()

    def _follow(self) -> None:
        with self._file.open("rb") as stream:
            while not self._over.wait(_POLL):
                while self._advance(stream):
                    pass

    def _advance(self, stream: BinaryIO) -> bool:
        """Move past the next record; returns False if it is not complete in the file."""
        stream.seek(self._place)
        head = stream.read(_RECORD.size)
        if len(head) < _RECORD.size:
            return False
        code, length = _RECORD.unpack(head)
        end = self._place + _RECORD.size + length
        if self._file.stat().st_size < end:
            return False
        if code == _CHUNK_CODE:
            self._chunk, _ = _CHUNK.unpack(stream.read(_CHUNK.size))
        elif code == _INDEX_CODE:  # follows its chunk
            self._count(_INDEX.unpack(stream.read(_INDEX.size))[1] // _ENTRY)
        self._place = end
        return True

    def _count(self, messages: int) -> None:
        self.messages += messages
        self.latencies.append((time.time_ns() - self._chunk) * 1e-9)
        self.newest = time.monotonic()
