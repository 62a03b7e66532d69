"""Growth of a fault: its severity over time or over passages of its tooth, by a table or a law."""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, Literal, Self

from pydantic import Discriminator, Field, Tag, model_validator

from .quantity import Section, quantity

_MOST_POINTS = 1000


class Table(Section):
    """Severities at given times, or after given passages; linear between them, constant outside."""

    law: Literal["table"] = Field("table", description="severities at given times or passages")
    time: tuple[float, ...] = quantity(
        "s", "simulated times of the severities", (), max_length=_MOST_POINTS
    )
    meshes: tuple[float, ...] = quantity(
        "", "passages of the faulty tooth through a mesh, in place of times", (),
        max_length=_MOST_POINTS,
    )  # fmt: skip
    depth: tuple[float, ...] = quantity(
        "m", "severities of a fault with a depth", (), max_length=_MOST_POINTS
    )
    stiffness_loss: tuple[float, ...] = quantity(
        "", "severities of a fault with a stiffness_loss", (), max_length=_MOST_POINTS
    )

    @property
    def places(self) -> tuple[float, ...]:
        """Times [s], or numbers of passages."""
        return self.time or self.meshes

    @property
    def severities(self) -> tuple[float, ...]:
        """Severities there, in the unit of the fault."""
        return self.depth or self.stiffness_loss

    @property
    def last(self) -> float:
        """Largest severity."""
        return max(self.severities)

    @model_validator(mode="after")
    def _pairs(self) -> Self:
        for one, other in (("time", "meshes"), ("depth", "stiffness_loss")):
            if bool(getattr(self, one)) == bool(getattr(self, other)):
                raise ValueError(f"{one}, {other}: a table needs exactly one of them")
        if len(self.places) != len(self.severities):
            raise ValueError(
                f"has {len(self.places)} times or meshes and {len(self.severities)} severities: "
                "must have as many"
            )
        if self.places[0] < 0.0 or not all(a < b for a, b in pairwise(self.places)):
            raise ValueError("time or meshes: must be at least 0, in increasing order")
        return self


class LawGrowth(Section):
    """Growth with each passage of the tooth through a mesh."""

    until: float = quantity("m", "depth at which the growth ends", gt=0.0, le=0.1)
    acceleration: float = quantity(
        "", "passages that count for each simulated one, as real growth takes 1e5 to 1e7", 1.0,
        gt=0.0, le=1e12,
    )  # fmt: skip
    force: float | None = quantity(
        "N", "load of a tooth pair with the stated stress or pressure, which then follow the "
        "largest load of the tooth in each passage; without it, they are constant", None,
        gt=0.0, le=1e9,
    )  # fmt: skip

    @property
    def last(self) -> float:
        """Largest severity."""
        return self.until

    @property
    def kind(self) -> str:
        """Name of the law."""
        return type(self).__name__.lower()


class Paris(LawGrowth):
    """Growth of a crack, da/dN = C (Y stress_range sqrt(pi a))^m (Paris and Erdogan 1963, (4)).

    A crack of depth 0 does not grow.
    """

    law: Literal["paris"] = Field(description="Paris and Erdogan 1963")
    constant: float = quantity(
        "", "C, with da/dN in m per cycle and stress intensities in MPa sqrt(m)", gt=0.0, le=1e-3
    )
    exponent: float = quantity("", "m", gt=0.0, le=20.0)
    geometry: float = quantity("", "geometry factor Y of the crack", 1.12, gt=0.0, le=10.0)
    stress_range: float = quantity(
        "Pa", "range of the stress at the root in a passage", gt=0.0, le=1e10
    )


class Archard(LawGrowth):
    """Growth of wear: coefficient x pressure x sliding way, 2 half_width slip, in each passage.

    (Archard 1953; Andersson and Eriksson 1990.) Pressure and half width both grow with the square
    root of the force, so the depth grows in proportion to it.
    """

    law: Literal["archard"] = Field(description="Archard 1953")
    coefficient: float = quantity("", "wear coefficient [m2/N]", gt=0.0, le=1e-9)
    pressure: float = quantity("Pa", "Hertz pressure", gt=0.0, le=1e11)
    half_width: float = quantity("m", "half the width of the contact", gt=0.0, le=0.1)
    slip: float = quantity("", "sliding over rolling, abs(1 - u2/u1)", gt=0.0, le=10.0)


Growth = Annotated[
    Annotated[Table, Tag("table")]
    | Annotated[Paris, Tag("paris")]
    | Annotated[Archard, Tag("archard")],
    Discriminator(
        lambda given: given.get("law", "table") if isinstance(given, dict) else given.law
    ),
]
