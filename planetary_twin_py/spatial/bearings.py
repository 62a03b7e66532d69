"""Axial and tilting stiffness of the bearings of a scene."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..scene.supports import Supports

BODIES = ("sun", "planet", "ring", "carrier")
STIFFNESSES = ("axial", "tilting")


def missing_stiffnesses(supports: Supports, why: str) -> str | None:
    """Refusal of supports without an axial or a tilting stiffness; one of 0 is a stiffness.

    Args:
        supports: supports of the scene.
        why: what requires them, for example "with dynamics = 'spatial'".

    Returns:
        The missing fields and what requires them; None if every body has both.
    """
    missing = [
        f"supports.{body}.{name}"
        for body in BODIES
        for name in STIFFNESSES
        if getattr(getattr(supports, body), name) is None
    ]
    if not missing:
        return None
    return (
        f"{', '.join(missing)}: missing; {why} every body requires an axial and a tilting "
        "stiffness, 0 where it floats"
    )
