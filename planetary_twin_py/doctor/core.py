"""The compiled core: whether it is built, and for this processor."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module

from .finding import Finding

_REBUILD = "make setup, or pip install --force-reinstall planetary_twin_py"


def check() -> Iterator[Finding]:
    """Findings about the compiled core."""
    try:
        core = import_module("planetary_twin_py._core")
    except ImportError as reason:
        yield Finding("core", "broken", str(reason), _REBUILD)
        return
    best, name_of = core.runnable_levels()[0], core.levels.architecture
    details = f"sources {core.SOURCES}, built for {name_of(core.LEVEL)}"
    if best == core.LEVEL:
        yield Finding("core", "sound", details)
    else:
        details += f", slower than {name_of(best)}, which this processor runs"
        yield Finding("core", "sound", details, _REBUILD)
    try:
        import_module(f"{core.__name__}.axes")
    except ImportError as reason:
        yield Finding(
            "moving axes", "absent", f"their core is not compiled: {reason}", "make setup"
        )
