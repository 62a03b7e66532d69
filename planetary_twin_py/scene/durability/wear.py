"""Wear of all flanks with their passages."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from ..quantity import Section, quantity


class WearLaw(Section):
    """Wear of all flanks, k (F/L) |1 - V2/V1| in each passage (Archard 1953).

    Coefficients of tests differ by ten powers of ten, and by half on one rig (Podra and Andersson
    1999): shape, place and ratios of the wear follow from the gears, its depth from a coefficient
    that is fitted to a measurement of this gearbox.
    """

    coefficient: float = quantity(
        "1/Pa", "wear coefficient k without film; about 1e-19 to 1e-18 of lubricated steel",
        ge=0.0, le=1e-9,
    )  # fmt: skip
    film: Literal["constant", "priest_taylor"] = Field(
        "constant",
        description="constant: k everywhere; priest_taylor: k below a specific film of 0.5, none "
        "above 4, linear between",
    )
