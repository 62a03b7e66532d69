"""Room for recordings where one would land now."""

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
    """Whether the folder can be written, and for how long there is room."""
    folder = _FOLDER if _FOLDER.exists() else Path.cwd()
    if not os.access(folder, os.W_OK):
        told = f"{folder.resolve()} cannot be written"
        yield Finding("disk", "broken", told, "run from a folder of your own")
        return
    free = shutil.disk_usage(folder).free
    told = f"{free * 1e-9:.0f} GB free in {folder.resolve()}: {free / _RATE / 3600.0:.0f} h or more"
    if free < _RATE * _ENOUGH:
        yield Finding("disk", "broken", told, "free some, or record onto another disk")
    else:
        yield Finding("disk", "sound", told)
