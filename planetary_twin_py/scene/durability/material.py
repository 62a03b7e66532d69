"""Strength of gears: stress over number of cycles to failure."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import Field, model_validator

from ..quantity import Section, quantity

Treatment = Literal["case_hardened", "through_hardened"]

# Stresses of the endurance limit of case-hardened 18CrNiMo7-6 and of quenched and tempered
# 34CrNiMo6, as KISSsoft 03/2017 prints them for ISO 6336-5, quality MQ [Pa].
_LIMITS = {"case_hardened": (1500e6, 430e6), "through_hardened": (700e6, 290e6)}


class Strength(Section):
    """Strength of one kind of gear; the name of a treatment stands for typical values."""

    treatment: Treatment = Field("case_hardened", description="sets the shape of the S-N curves")
    flank: float = quantity(
        "Pa", "contact stress that 5e7 passages lead to pitting; default: by the treatment", None,
        gt=0.0, le=1e10,
    )  # fmt: skip
    root: float = quantity(
        "Pa", "nominal stress at the root that 3e6 passages lead to breakage (sigma_Flim); the "
        "local stress is twice this, as in the test gears; default: by the treatment", None,
        gt=0.0, le=1e10,
    )  # fmt: skip

    @model_validator(mode="before")
    @classmethod
    def _by_treatment(cls, given: Any) -> Any:
        values = {"treatment": given} if isinstance(given, str) else given
        if not isinstance(values, dict):
            return values
        limits = _LIMITS.get(values.get("treatment", "case_hardened"))
        if limits is None:
            return values
        flank, root = limits
        return {"flank": flank, "root": root} | {
            name: value for name, value in values.items() if value is not None
        }


class Materials(Section):
    """Strength of the gears by their names."""

    sun: Strength = Field(Strength(), description="strength of the sun")
    planet: Strength = Field(Strength(), description="strength of the planets")
    ring: Strength = Field(Strength(), description="strength of the ring")
    beyond: Literal["falls", "endless"] = Field(
        "falls",
        description="life at stresses below the last corner of an S-N curve; falls: finite, with "
        "the slope to 0.85 of the strength at 1e10 cycles; endless: no damage below the strength",
    )
    reversed_bending: float = quantity(
        "", "factor on the strength of planet roots, which are bent both ways", 0.7, gt=0.0, le=1.0
    )
