"""The cache of compiled kernels."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from .._compile import cache_folder
from .finding import Finding

_LARGE = 1e9  # [B] of kernels of other versions that are worth a finding


def check() -> Iterator[Finding]:
    """Findings about the kernels of this version, and of other versions."""
    folder = cache_folder()
    yield _own(folder)
    left = sum(_size(other) for other in folder.parent.glob("*") if other != folder)
    if left > _LARGE:
        details = f"{left * 1e-9:.1f} GB of kernels of other versions"
        yield Finding("old kernels", "sound", details, f"rm -r {folder.parent}")


def _own(folder: Path) -> Finding:
    writable = next(parent for parent in (folder, *folder.parents) if parent.exists())
    if not os.access(writable, os.W_OK):
        details = f"{writable} is not writable: every start compiles for half a minute"
        return Finding("kernels", "broken", details, "set XDG_CACHE_HOME to a writable folder")
    if not any(folder.rglob("*.nbc")):
        details = f"not compiled yet: the first run compiles them into {folder}, in half a minute"
        return Finding("kernels", "absent", details, "planetary-twin simulate --duration 0.01")
    return Finding("kernels", "sound", f"{_size(folder) * 1e-6:.0f} MB in {folder}")


def _size(folder: Path) -> int:
    return sum(file.stat().st_size for file in folder.rglob("*") if file.is_file())
