"""File with a line per completed point, from which an interrupted study resumes."""

from __future__ import annotations

import json
from pathlib import Path
from typing import IO, Self

from .work import Failure, Found


class Journal:
    """Results by the key of their point, in a file that stays valid if the process is killed.

    Failures are not stored, so that they are tried again.

    Args:
        path: path of the file; it is created if it does not exist.

    Raises:
        OSError: `path` cannot be read or written.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.done: dict[str, Found] = {}
        if path.exists():
            self._read()
        self._stream: IO[str] = path.open("a", encoding="utf-8")

    def add(self, key: str, found: Found) -> None:
        """Store the result of the point with this key."""
        if isinstance(found, Failure):
            return
        self.done[key] = found
        # JSON round-trips floats exactly.
        self._stream.write(json.dumps({"key": key, "figures": found}) + "\n")
        self._stream.flush()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._stream.close()

    def _read(self) -> None:
        """Read complete lines, and remove an incomplete last line."""
        text = self.path.read_bytes()
        complete = text[: text.rfind(b"\n") + 1]
        for line in complete.splitlines():
            entry = json.loads(line)
            self.done[entry["key"]] = entry["figures"]
        if len(complete) < len(text):
            with self.path.open("r+b") as stream:
                stream.truncate(len(complete))
