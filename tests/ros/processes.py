"""Which processes there are."""

from __future__ import annotations

from pathlib import Path


def working_in(folder: Path) -> list[int]:
    """Processes whose working directory is `folder`."""
    found = []
    for entry in Path("/proc").iterdir():
        try:
            if entry.name.isdigit() and (entry / "cwd").resolve(strict=True) == folder:
                found.append(int(entry.name))
        except OSError:
            continue
    return found


def holding(process: int, name: str) -> bool:
    """Whether a process has mapped a file with `name` in its path."""
    try:
        return name in Path(f"/proc/{process}/maps").read_text()
    except OSError:
        return False
