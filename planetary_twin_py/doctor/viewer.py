"""The Rerun viewer, its display and its graphics driver."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path

from .finding import Finding

_TIMEOUT = 60.0  # [s], also where other programs keep the processor busy
_DRIVERS = ("/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d")


def check() -> Iterator[Finding]:
    """Whether the viewer starts, and whether windows and pictures are possible."""
    if find_spec("rerun_cli") is None:
        return  # reported with the extras
    import rerun_cli

    binary = Path(rerun_cli.__file__).parent / "rerun"
    try:
        done = subprocess.run(
            [str(binary), "--version"], capture_output=True, text=True, timeout=_TIMEOUT
        )
    except (OSError, subprocess.TimeoutExpired) as reason:
        yield Finding("viewer", "broken", str(reason), "pip install --force-reinstall rerun-sdk")
        return
    if done.returncode:
        details = (done.stderr.strip().splitlines() or [f"exit code {done.returncode}"])[-1]
        yield Finding("viewer", "broken", details, "pip install --force-reinstall rerun-sdk")
        return
    yield Finding("viewer", "sound", " ".join(done.stdout.split()[:2]))
    yield _window()
    yield _driver()


def _window() -> Finding:
    from ..view.viewer import has_display

    if has_display():
        return Finding("display", "sound", "windows can be opened")
    details = "none: view works with --save, --serve and --screenshot"
    return Finding("display", "absent", details)


def _driver() -> Finding:
    found = [file for folder in _DRIVERS for file in Path(folder).glob("*.json")]
    if found:
        return Finding("graphics", "sound", ", ".join(sorted(file.stem for file in found)))
    details = "no Vulkan driver found: pictures and windows may fail"
    return Finding("graphics", "absent", details, "Debian: apt install mesa-vulkan-drivers")
