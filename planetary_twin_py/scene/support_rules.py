"""Bearings that the teeth need for an equilibrium, and data of bearings that spatial runs need."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .supports import Support, Supports

BODIES = ("sun", "planet", "ring", "carrier")
STIFFNESSES = ("axial", "tilting")


def unsupported(supports: Supports) -> Iterator[str]:
    """Errors of bearings that leave the gear set, or its planets, without support in the plane."""
    central = ("sun", "ring", "carrier")
    if all(_floats(getattr(supports, body)) for body in central):
        fields = ", ".join(f"supports.{body}.bearing" for body in central)
        yield (
            f"{fields} = 0: one of them must be above 0 N/m, or rolling, or there is no static "
            "equilibrium: nothing else holds the gears in the housing"
        )
    if _floats(supports.planet):
        yield (
            "supports.planet.bearing = 0: must be above 0 N/m, or rolling, or there is no static "
            "equilibrium: the pins carry the torque between planets and carrier"
        )


def unsupported_along(supports: Supports) -> Iterator[str]:
    """Errors of bearings that leave a gear with helical teeth without support along its axis.

    The thrusts of both meshes of a planet cancel, those of sun and ring do not.

    Args:
        supports: the bearings, with their axial stiffness.
    """
    for body in ("sun", "ring"):
        if getattr(supports, body).axial == 0.0:
            yield (
                f"supports.{body}.axial = 0: must be above 0 N/m with helical teeth "
                f"(gearset.helix_angle), which push the {body} along its axis"
            )


def _floats(support: Support) -> bool:
    return support.rolling is None and not support.bearing


def missing_stiffnesses(supports: Supports) -> Iterator[str]:
    """Fields that a spatial run needs and the scene does not have.

    Returns:
        Names of the fields, for example "supports.sun.axial".
    """
    for body in BODIES:
        for name in STIFFNESSES:
            if getattr(getattr(supports, body), name) is None:
                yield f"supports.{body}.{name}"
