"""Clock readings and software versions of this host, for the metadata of a recording.

Readings of the system clock and the steady clock at the start, during and at the end of a recording
show whether the system clock was set meanwhile, and allow times of other hosts to be compared.
"""

from __future__ import annotations

import platform
import time
from collections.abc import Iterable
from importlib.metadata import PackageNotFoundError, version

SOFTWARE_RECORD = "planetary_twin_software"


def host_clocks() -> dict[str, str]:
    """Readings of the clocks of this host [ns]; the steady clock is read between two readings of
    the system clock."""
    before, steady, after = time.time_ns(), time.monotonic_ns(), time.time_ns()
    return {
        "system": str((before + after) // 2),
        "steady": str(steady),
        "uncertainty": str((after - before + 1) // 2),
    }


def software(packages: Iterable[str]) -> dict[str, str]:
    """Versions of Python, the operating system and the installed `packages`."""
    versions = {"python": platform.python_version(), "system": platform.platform()}
    for package in packages:
        try:
            versions[package] = version(package)
        except PackageNotFoundError:
            continue
    return versions
