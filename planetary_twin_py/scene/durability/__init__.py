"""Section `durability:` of a scene: what its damage is counted by."""

from __future__ import annotations

from pydantic import Field

from ..quantity import Section, quantity
from .bearings import RatedBearing, RatedBearings
from .material import Materials, Strength
from .micropitting import Micropitting
from .scuffing import Scuffing
from .shafts import RatedShaft, RatedShafts
from .wear import WearLaw

__all__ = [
    "Durability", "Materials", "Micropitting", "RatedBearing", "RatedBearings", "RatedShaft",
    "RatedShafts", "Scuffing", "Strength", "WearLaw",
]  # fmt: skip


class Durability(Section):
    """Materials, bearings and limits, by which a run counts damage; wear. No standard rating."""

    material: Materials = Field(Materials(), description="strength of the gears")
    face_load_factor: float = quantity(
        "",
        "load per width where it is largest, over its mean; not in the model, so 1 is a load that "
        "is even along the face",
        1.0, ge=1.0, le=10.0,
    )  # fmt: skip
    bearings: RatedBearings = Field(RatedBearings(), description="rated rolling bearings")
    shafts: RatedShafts = Field(RatedShafts(), description="shafts of the machines")
    ring_root: bool = Field(
        False, description="count the root of a spur ring, whose stress takes a second to compute"
    )
    teeth: bool = Field(
        False, description="count every tooth by itself, as for gears with faults of single teeth"
    )
    scuffing: Scuffing | None = Field(None, description="limit of the contact temperature")
    micropitting: Micropitting | None = Field(None, description="limit of the specific film")
    wear: WearLaw | None = Field(None, description="wear of all flanks")
