"""The Rerun viewer, its display and its graphics driver."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path

from .finding import Finding

_TIMEOUT = 60.0  # [s], also where other programs keep the processor busy
_DRIVERS = (
    *("/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d"),
    *("/usr/local/share/vulkan/icd.d", "/usr/local/etc/vulkan/icd.d"),
)
_NAMED = ("VK_DRIVER_FILES", "VK_ICD_FILENAMES")
"""Variables of the Vulkan loader in place of `_DRIVERS`; the first one that is set counts."""


def check() -> Iterator[Finding]:
    """Whether the viewer starts, and whether windows and pictures are possible."""
    if find_spec("rerun_cli") is None:
        return  # reported with the extras
    from ..view.viewer import BINARY, private_environment

    try:
        done = subprocess.run(
            [str(BINARY), "--version"],
            capture_output=True,
            text=True,
            timeout=_TIMEOUT,
            env=private_environment(),
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
    places, source = _places()
    found = [
        file
        for place in places
        for file in (place.glob("*.json") if place.is_dir() else [place])
        if file.is_file()
    ]
    if found:
        return Finding("graphics", "sound", ", ".join(sorted(file.stem for file in found)))
    details = f"no Vulkan driver found in {source}: pictures and windows may fail"
    return Finding("graphics", "absent", details, "Debian: apt install mesa-vulkan-drivers")


def _places() -> tuple[list[Path], str]:
    """Files or folders where the Vulkan loader looks for drivers, and where this is stated."""
    for name in _NAMED:
        if given := os.environ.get(name):
            return [Path(place) for place in given.split(os.pathsep)], f"{name} = {given}"
    return [Path(folder) for folder in _DRIVERS], ", ".join(_DRIVERS[:2])
