"""Limit of the contact temperature."""

from __future__ import annotations

from typing import Self

from pydantic import Field, model_validator

from ..quantity import Section, quantity


class Scuffing(Section):
    """Temperature at which flanks scuff: given, or from a test of the oil."""

    temperature: float | None = quantity(
        "K", "contact temperature at which the flanks scuff", None, gt=273.15, le=1500.0
    )
    fzg_stage: int | None = Field(
        None, description="failure load stage of the oil in the FZG test A/8.3/90", ge=1, le=14
    )

    @model_validator(mode="after")
    def _one_of_them(self) -> Self:
        if (self.temperature is None) == (self.fzg_stage is None):
            raise ValueError("temperature, fzg_stage: give one of them")
        return self
