"""Local faults: one faulty tooth of one gear."""

from __future__ import annotations

import math
from typing import Annotated, Literal, Self

from pydantic import Discriminator, Field, Tag, model_validator

from .quantity import Section, quantity

MOST_FAULTS = 4
SPALL_EDGE = 0.02  # base pitches over which a contact line enters or leaves a spall


class ToothFault(Section):
    """Faulty tooth: teeth are numbered from 0, the tooth that meets planet 1 first.

    A tooth of a planet meets the sun and the ring with opposite flanks.
    """

    gear: Literal["sun", "planet", "ring"] = Field(description="gear with the faulty tooth")
    planet: int = Field(1, ge=1, le=7, description="number of the planet, if gear is planet")
    tooth: int = Field(
        0, ge=0, le=2999, description="number of the tooth; 0 is the one that meets planet 1 first"
    )


class Crack(ToothFault):
    """A crack at the root, which reduces the stiffness for both flanks in every mesh."""

    kind: Literal["crack"] = Field(description="a crack at the root")
    stiffness_loss: float | None = quantity(
        "", "relative stiffness loss of a pair with this tooth", None, gt=0.0, le=0.9
    )
    depth: float | None = quantity(
        "m", "length of the crack, from which the loss is computed", None, gt=0.0, le=0.1
    )
    angle: float = quantity(
        "rad",
        "angle between the crack and the centre line of the tooth",
        math.radians(70.0),
        ge=0.5,
        le=1.58,
    )

    @model_validator(mode="after")
    def _one_measure(self) -> Self:
        if (self.stiffness_loss is None) == (self.depth is None):
            raise ValueError("stiffness_loss, depth: a crack needs exactly one of them")
        return self


class FlankFault(ToothFault):
    """A fault of one flank."""

    flank: Literal["drive", "coast"] = Field(
        "drive", description="drive: the flank that is loaded if the torque on the sun is positive"
    )
    mesh: Literal["sun", "ring"] = Field("sun", description="mesh of a planet with the fault")


class Spall(FlankFault):
    """A pit in the flank, where part of the face width carries no load."""

    kind: Literal["spall"] = Field(description="a pit in a flank")
    begin: float = quantity(
        "", "start on the path of contact [base pitches]", -0.1, ge=-2.0, le=2.0
    )
    end: float = quantity("", "end on the path of contact [base pitches]", 0.1, ge=-2.0, le=2.0)
    stiffness_loss: float = quantity("", "relative stiffness loss in this range", gt=0.0, le=0.9)

    @model_validator(mode="after")
    def _runs_forwards(self) -> Self:
        if not self.end - self.begin >= 2.0 * SPALL_EDGE:
            raise ValueError(f"end = {self.end:g}: must be at least begin + {2.0 * SPALL_EDGE:g}")
        return self


class Wear(FlankFault):
    """A uniformly worn flank, which increases the backlash while it alone is in contact."""

    kind: Literal["wear"] = Field(description="a worn flank")
    depth: float = quantity("m", "worn depth along the line of action", gt=0.0, le=1e-3)


def _kind(fault: object) -> object:
    return fault.get("kind") if isinstance(fault, dict) else getattr(fault, "kind", None)


Fault = Annotated[
    Annotated[Crack, Tag("crack")] | Annotated[Spall, Tag("spall")] | Annotated[Wear, Tag("wear")],
    Discriminator(_kind),
]
