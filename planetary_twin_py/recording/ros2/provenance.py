"""What this host's clocks say at one moment, and on what software: so that a file tells it later.

With readings of the system clock and the steady clock from a recording's beginning, way and end it
is seen whether the system clock was set meanwhile, and times of other hosts can be compared.
"""

from __future__ import annotations

import platform
import time
from collections.abc import Iterable
from importlib.metadata import PackageNotFoundError, version

SOFTWARE_RECORD = "planetary_twin_software"


def host_clocks() -> dict[str, str]:
    """Readings of this host's clocks [ns], the steady one taken between two of the system's."""
    before, steady, after = time.time_ns(), time.monotonic_ns(), time.time_ns()
    return {
        "system": str((before + after) // 2),
        "steady": str(steady),
        "uncertainty": str((after - before + 1) // 2),
    }


def software(packages: Iterable[str]) -> dict[str, str]:
    """Versions of what runs here: Python, the operating system, and `packages` as installed."""
    found = {"python": platform.python_version(), "system": platform.platform()}
    for package in packages:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            continue
    return found
