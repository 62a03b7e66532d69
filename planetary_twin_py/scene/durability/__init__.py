"""What wears and damages the gears in the course of their life."""

from __future__ import annotations

from pydantic import Field

from ..quantity import Section
from .wear import WearLaw


class Durability(Section):
    """Laws of wear and damage; a scene without them computes none."""

    wear: WearLaw | None = Field(None, description="wear of all flanks")
