"""Local faults: one tooth of one gear that is not as the others."""

from __future__ import annotations

import math
from typing import Annotated, Literal, Self

from pydantic import Discriminator, Field, Tag, model_validator

from .quantity import Section, quantity

MOST_FAULTS = 4
SPALL_EDGE = 0.02  # base pitches over which a contact line runs onto a spall


class ToothFault(Section):
    """Which tooth: teeth count from 0, the one that meets planet 1 first.

    A tooth of a planet meets the sun and the ring with opposite flanks.
    """

    gear: Literal["sun", "planet", "ring"] = Field(description="which gear the tooth is of")
    planet: int = Field(1, ge=1, le=7, description="which planet, if the gear is one")
    tooth: int = Field(
        0, ge=0, le=2999, description="which tooth, counted from 0, that which meets planet 1 first"
    )


class Crack(ToothFault):
    """A crack at the root, which softens the tooth on both flanks in every mesh."""

    kind: Literal["crack"] = Field(description="a crack at the root")
    stiffness_loss: float | None = quantity(
        "", "share of the stiffness a pair with this tooth has lost", None, gt=0.0, le=0.9
    )
    depth: float | None = quantity(
        "m", "length of the crack, from which its loss is computed", None, gt=0.0, le=0.1
    )
    angle: float = quantity(
        "rad", "of the crack to the centre line of the tooth", math.radians(70.0), ge=0.5, le=1.58
    )

    @model_validator(mode="after")
    def _one_measure(self) -> Self:
        if (self.stiffness_loss is None) == (self.depth is None):
            raise ValueError("stiffness_loss, depth: give one of them for a crack")
        return self


class FlankFault(ToothFault):
    """A fault of one flank."""

    flank: Literal["drive", "coast"] = Field(
        "drive", description="drive: the flank that carries where the torque on the sun is positive"
    )
    mesh: Literal["sun", "ring"] = Field("sun", description="of a planet: which mesh it is in")


class Spall(FlankFault):
    """A pit in the flank, where part of the face width no longer carries."""

    kind: Literal["spall"] = Field(description="a pit in a flank")
    begin: float = quantity("", "position on the path [base pitches]", -0.1, ge=-2.0, le=2.0)
    end: float = quantity("", "position on the path [base pitches]", 0.1, ge=-2.0, le=2.0)
    stiffness_loss: float = quantity("", "share of the stiffness lost there", gt=0.0, le=0.9)

    @model_validator(mode="after")
    def _runs_forwards(self) -> Self:
        if not self.end - self.begin >= 2.0 * SPALL_EDGE:
            raise ValueError(f"end = {self.end:g}: must be at least begin + {2.0 * SPALL_EDGE:g}")
        return self


class Wear(FlankFault):
    """A flank worn by `depth` all over, which adds to the backlash while it carries alone."""

    kind: Literal["wear"] = Field(description="a worn flank")
    depth: float = quantity("m", "missing material, on the line of action", gt=0.0, le=1e-3)


def _kind(fault: object) -> object:
    return fault.get("kind") if isinstance(fault, dict) else getattr(fault, "kind", None)


Fault = Annotated[
    Annotated[Crack, Tag("crack")] | Annotated[Spall, Tag("spall")] | Annotated[Wear, Tag("wear")],
    Discriminator(_kind),
]
