"""Free disk space for recordings."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from pathlib import Path

from .finding import Finding

_FOLDER = Path("recordings")
_RATE = 4e6  # [B/s] of a run with three planets, its waveform at 50 kHz, before compression
_ENOUGH = 3600.0  # [s]


def check() -> Iterator[Finding]:
    """Whether the folder of recordings is writable, and how long a recording fits."""
    folder = _FOLDER if _FOLDER.exists() else Path.cwd()
    if not os.access(folder, os.W_OK):
        details = f"{folder.resolve()} is not writable"
        yield Finding("disk", "broken", details, "run from a writable folder")
        return
    free = shutil.disk_usage(folder).free
    hours = free / _RATE / 3600.0
    details = f"{free * 1e-9:.0f} GB free in {folder.resolve()}: {hours:.0f} h or more"
    if free < _RATE * _ENOUGH:
        yield Finding("disk", "broken", details, "free some space, or record to another disk")
    else:
        yield Finding("disk", "sound", details)
