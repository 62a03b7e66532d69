"""Where compiled kernels are kept, and whether a start finds them."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from .._compile import cache_folder
from .finding import Finding

_ROOM = 1e9  # [B] of kernels of other versions, from which on it is worth a line


def check() -> Iterator[Finding]:
    """The folder of this version's kernels, and what others have left beside it."""
    folder = cache_folder()
    yield _kept(folder)
    left = sum(_size(other) for other in folder.parent.glob("*") if other != folder)
    if left > _ROOM:
        told = f"{left * 1e-9:.1f} GB of kernels of other versions"
        yield Finding("old kernels", "sound", told, f"rm -r {folder.parent}")


def _kept(folder: Path) -> Finding:
    writable = next(parent for parent in (folder, *folder.parents) if parent.exists())
    if not os.access(writable, os.W_OK):
        told = f"{writable} cannot be written: every start compiles for half a minute"
        return Finding("kernels", "broken", told, "set XDG_CACHE_HOME to a folder of your own")
    if not any(folder.rglob("*.nbc")):
        told = f"not compiled yet: the first run does it, in half a minute, into {folder}"
        return Finding("kernels", "absent", told, "planetary-twin simulate --duration 0.01")
    return Finding("kernels", "sound", f"{_size(folder) * 1e-6:.0f} MB in {folder}")


def _size(folder: Path) -> int:
    return sum(file.stat().st_size for file in folder.rglob("*") if file.is_file())
