"""Python, and the packages that the extras need."""

from __future__ import annotations

import platform
import sys
from collections.abc import Iterator
from importlib.metadata import PackageNotFoundError, requires, version

from packaging.requirements import Requirement

from .finding import Finding

PACKAGE = "planetary_twin_py"
# Purpose of each extra, without those for developers and for ROS.
EXTRAS = {
    "recording": "read, verify and recover recordings",
    "analysis": "export recordings as tables",
    "measured": "read waveforms of HDF5, MAT 7.3 and TDMS",
    "view": "view recordings",
    "plots": "draw plots",
    "studies": "run parameter studies",
}


def check() -> Iterator[Finding]:
    """The interpreter, the package, and each extra."""
    running = f"{platform.python_implementation()} {platform.python_version()}, {sys.executable}"
    yield Finding("python", "sound", running)
    yield Finding("model", "sound", f"{PACKAGE} {version(PACKAGE)}")
    for extra, purpose in EXTRAS.items():
        lacking = [f"{need.name}{need.specifier}" for need in _needs(extra) if not _installed(need)]
        if lacking:
            fix = f"pip install '{PACKAGE}[{extra}]'"
            yield Finding(extra, "absent", f"to {purpose}: missing {', '.join(lacking)}", fix)
        else:
            yield Finding(extra, "sound", purpose)


def _needs(extra: str) -> list[Requirement]:
    """Requirements of an extra."""
    found = [Requirement(text) for text in requires(PACKAGE) or []]
    return [need for need in found if need.marker and need.marker.evaluate({"extra": extra})]


def _installed(need: Requirement) -> bool:
    try:
        return need.specifier.contains(version(need.name), prereleases=True)
    except PackageNotFoundError:
        return False
