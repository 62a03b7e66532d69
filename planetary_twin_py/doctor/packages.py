"""Python, and the packages that parts of this project need."""

from __future__ import annotations

import platform
import sys
from collections.abc import Iterator
from importlib.metadata import PackageNotFoundError, requires, version

from packaging.requirements import Requirement

from .finding import Finding

PACKAGE = "planetary_twin_py"
# What the extras are good for; those for developers and for ROS are no matter here.
EXTRAS = {
    "recording": "read, verify and recover recordings",
    "analysis": "export recordings as tables",
    "view": "look at recordings",
    "plots": "draw",
    "studies": "sweep, and draw and fit what comes of it",
}


def check() -> Iterator[Finding]:
    """The interpreter, the package, and each extra."""
    running = f"{platform.python_implementation()} {platform.python_version()}, {sys.executable}"
    yield Finding("python", "sound", running)
    yield Finding("model", "sound", f"{PACKAGE} {version(PACKAGE)}")
    for extra, purpose in EXTRAS.items():
        lacking = [str(need) for need in _needs(extra) if not _installed(need)]
        if lacking:
            mend = f"pip install '{PACKAGE}[{extra}]'"
            yield Finding(extra, "absent", f"to {purpose}: lacks {', '.join(lacking)}", mend)
        else:
            yield Finding(extra, "sound", purpose)


def _needs(extra: str) -> list[Requirement]:
    """Requirements that this extra adds."""
    found = [Requirement(text) for text in requires(PACKAGE) or []]
    return [need for need in found if need.marker and need.marker.evaluate({"extra": extra})]


def _installed(need: Requirement) -> bool:
    try:
        return need.specifier.contains(version(need.name), prereleases=True)
    except PackageNotFoundError:
        return False
