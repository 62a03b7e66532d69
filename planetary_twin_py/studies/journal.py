"""What is done stays done: a line for each finished point, beside the table to be."""

from __future__ import annotations

import json
from pathlib import Path
from typing import IO

from .work import Failure, Found


class Journal:
    """Found figures by the key of their point, in a file that survives a kill at any moment.

    Failures are not kept: what made them may have been mended.

    Raises:
        OSError: `path` can be neither read nor written.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.done: dict[str, Found] = {}
        if path.exists():
            self._read()
        self._stream: IO[str] = path.open("a", encoding="utf-8")

    def add(self, key: str, found: Found) -> None:
        """Keep what was found at a point."""
        if isinstance(found, Failure):
            return
        self.done[key] = found
        # JSON writes floats so that they are read back to the last bit.
        self._stream.write(json.dumps({"key": key, "figures": found}) + "\n")
        self._stream.flush()

    def close(self) -> None:
        """Keep the file for another time."""
        self._stream.close()

    def _read(self) -> None:
        """Take complete lines, and cut off what a kill left of the last one."""
        text = self.path.read_bytes()
        whole = text[: text.rfind(b"\n") + 1]
        for line in whole.splitlines():
            entry = json.loads(line)
            self.done[entry["key"]] = entry["figures"]
        if len(whole) < len(text):
            with self.path.open("r+b") as stream:
                stream.truncate(len(whole))
