"""Limit of the specific film."""

from __future__ import annotations

from ..quantity import Section, quantity


class Micropitting(Section):
    """Specific film below which micropits are expected, from a test of the oil."""

    permissible_film: float = quantity(
        "", "least permissible film thickness over composite roughness, by the film law of the "
        "scene", gt=0.0, le=10.0,
    )  # fmt: skip
