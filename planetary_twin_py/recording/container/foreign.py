"""Bags of rosbag2 in storage formats that this package does not read, and their conversion."""

from __future__ import annotations

import re
from pathlib import Path

CONVERT = "to convert it: rosbags-convert --src BAG --dst NEW --dst-storage mcap"
_SQLITE = b"SQLite format 3\0"
_ZSTD = b"\x28\xb5\x2f\xfd"
_MODE = re.compile(r"^\s*compression_mode:\s*[\"']?file\b", re.IGNORECASE | re.MULTILINE)
_LONGEST = 4_000_000  # characters of metadata.yaml that are searched


def how_stored(path: Path) -> str | None:
    """Detect a storage format that cannot be read.

    Args:
        path: path of the folder of a bag, or of one of its files.

    Returns:
        The format and the command that converts the bag, as the end of an error message; None for
        other bags.
    """
    folder = path if path.is_dir() else path.parent
    storage = _folder(path) if path.is_dir() else _file(path)
    hint = CONVERT.replace("BAG", str(folder)).replace("NEW", f"{folder.absolute().name}_mcap")
    return storage and f"{storage}; {hint}"


def _folder(folder: Path) -> str | None:
    for pattern, storage in (
        ("*.db3", "a bag in SQLite"),
        ("*.db3.zstd", "a bag in SQLite, compressed by file"),
        ("*.mcap.zstd", "a bag compressed by file"),
    ):
        if any(folder.glob(pattern)):
            return storage
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
