"""Axial and tilting stiffness of the bearings of a scene."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..scene.supports import Supports

BODIES = ("sun", "planet", "ring", "carrier")
STIFFNESSES = ("axial", "tilting")


def missing_stiffnesses(supports: Supports) -> Iterator[str]:
    """Fields that a spatial run needs and the scene does not have.

    Args:
        supports: supports of the scene.

    Returns:
        Names of the fields, for example "supports.sun.axial".
    """
    for body in BODIES:
        for name in STIFFNESSES:
            if getattr(getattr(supports, body), name) is None:
                yield f"supports.{body}.{name}"
