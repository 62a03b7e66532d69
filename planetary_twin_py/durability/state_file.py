"""Damage of a gearbox in a JSON file, which survives restarts, power cuts and kill -9.

A file is replaced as a whole: written beside it, flushed to the disk, renamed, and the folder
flushed. So it is always the last complete state. What cannot be read is never overwritten.
"""

from __future__ import annotations

import os
from pathlib import Path

from ..scene import Scene
from .damage_state import DamageState
from .state_text import parse_state, state_text


def read_state(path: Path, scene: Scene, parts: tuple[str, ...]) -> DamageState:
    """Read the state of a gearbox from a file.

    Args:
        path: path of the file.
        scene: scene of the gearbox.
        parts: names of its parts, see `durability.parts`.

    Returns:
        The state.

    Raises:
        ValueError: the file is no such state, is incomplete or of another version, or belongs to
            another gear set.
        OSError: the file cannot be read.
    """
    try:
        return parse_state(path.read_text(encoding="utf-8"), scene, parts)
    except ValueError as reason:  # also of other encodings
        text = "is not the damage of a gearbox: no text" if _no_text(reason) else str(reason)
        raise ValueError(f"{path}: {text}") from None


def write_text_safely(path: Path, text: str) -> None:
    """Replace a file as a whole: it has the former text or this one, whenever power fails.

    Args:
        path: path of the file; a link keeps its name.
        text: its contents.

    Raises:
        OSError: it cannot be written; the former file remains.
    """
    path = path.resolve()
    beside = path.with_name(f".{path.name}.writing")
    with beside.open("w", encoding="utf-8") as file:
        file.write(text)
        file.flush()
        os.fsync(file.fileno())
    beside.replace(path)
    folder = os.open(path.parent, os.O_RDONLY)
    try:
        os.fsync(folder)
    finally:
        os.close(folder)


class StateFile:
    """The file of one gearbox: read once, then written by this program alone.

    Args:
        path: path of the file, which need not exist.
        scene: scene of the gearbox.
        parts: names of its parts.

    Raises:
        ValueError, OSError: see `read_state`.
    """

    def __init__(self, path: Path, scene: Scene, parts: tuple[str, ...]) -> None:
        self.path, self._scene = path, scene
        self._seen = _stamp(path)
        self.state = read_state(path, scene, parts) if self._seen else DamageState(parts)
        """The state as read; empty without a file."""

    def write(self, state: DamageState) -> None:
        """Write a state.

        Args:
            state: the state.

        Raises:
            ValueError: another program has written the file since.
            OSError: it cannot be written; the former file remains.
        """
        if _stamp(self.path) != self._seen:
            raise ValueError(f"{self.path}: another program has changed it since it was read")
        write_text_safely(self.path, state_text(state, self._scene))
        self._seen = _stamp(self.path)


def _stamp(path: Path) -> tuple[int, int, int] | None:
    """What changes if another program writes a file; None without a file."""
    try:
        found = path.stat()
    except FileNotFoundError:
        return None
    return found.st_ino, found.st_mtime_ns, found.st_size


def _no_text(reason: ValueError) -> bool:
    return isinstance(reason, UnicodeDecodeError)
