"""The build of the core that a scene runs on: for axes that are held, or that move."""

from __future__ import annotations

from types import ModuleType
from typing import Any

from .. import _core
from ..scene import Scene


def library(scene: Scene) -> ModuleType:
    """Find the functions and records of the core for a scene.

    Both builds have the same names; a record of one is none of the other.

    Args:
        scene: whose axes are held, or move.

    Returns:
        `_core` or `_core.axes`.

    Raises:
        FileNotFoundError: `_core.axes` is not compiled yet.
    """
    if not scene.moving_axes:
        return _core
    try:
        from .._core import axes
    except ModuleNotFoundError as missing:
        raise FileNotFoundError(
            "axes that move need a part of the core that is not compiled yet: make setup"
        ) from missing
    return axes


def record_in(core: ModuleType, record: Any) -> Any:
    """Convert a record to a build of the core.

    Args:
        core: see `library`.
        record: of a type whose memory is the same in both builds: load or oil.

    Returns:
        A record with the same values.
    """
    own = getattr(core, type(record).__name__)()
    own.raw()[:] = record.raw()
    return own
