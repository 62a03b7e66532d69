"""Disks that are full or read-only, where this user may mount some."""

import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest


@contextmanager
def mounted(place: Path, size: str = "1m") -> Iterator[Path]:
    """A file system of its own at `place`; skips the test where mounting is refused."""
    place.mkdir()
    command = ["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", str(place)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        pytest.skip(f"no file system can be mounted: {done.stderr.strip()}")
    try:
        yield place
    finally:
        subprocess.run(["umount", "--lazy", str(place)], check=True)


def make_read_only(place: Path) -> None:
    """Refuse all writing to what is mounted at `place`, also root's."""
    subprocess.run(["mount", "-o", "remount,ro", str(place)], check=True)
