"""Bags of rosbag2 that are stored in another way than this package reads, and what to do."""

from __future__ import annotations

import re
from pathlib import Path

CONVERT = "rosbags-convert --src BAG --dst NEW --dst-storage mcap makes one that is read"
_SQLITE = b"SQLite format 3\0"
_ZSTD = b"\x28\xb5\x2f\xfd"
_MODE = re.compile(r"^\s*compression_mode:\s*[\"']?file\b", re.IGNORECASE | re.MULTILINE)
_LONGEST = 4_000_000  # characters of metadata.yaml that are looked at


def how_stored(path: Path) -> str | None:
    """How a bag is stored that cannot be read, and how it is converted; None of another.

    Args:
        path: of the folder of a bag, or of one of its files.

    Returns:
        The end of a message; `BAG` and `NEW` are replaced by folders.
    """
    folder = path if path.is_dir() else path.parent
    found = _folder(path) if path.is_dir() else _file(path)
    hint = CONVERT.replace("BAG", str(folder)).replace("NEW", f"{folder.absolute().name}_mcap")
    return found and f"{found}; {hint}"


def _folder(folder: Path) -> str | None:
    for pattern, found in (
        ("*.db3", "a bag in SQLite"),
        ("*.db3.zstd", "a bag in SQLite, compressed by file"),
        ("*.mcap.zstd", "a bag compressed by file"),
    ):
        if any(folder.glob(pattern)):
            return found
    metadata = folder / "metadata.yaml"
    if not metadata.is_file():
        return None
    with metadata.open(encoding="utf-8", errors="replace") as stream:
        by_file = _MODE.search(stream.read(_LONGEST))
    return "a bag compressed by file" if by_file else None


def _file(file: Path) -> str | None:
    with file.open("rb") as stream:
        begin = stream.read(len(_SQLITE))
    if begin == _SQLITE:
        return "a bag in SQLite"
    return "a file of a bag compressed by file" if begin.startswith(_ZSTD) else None
