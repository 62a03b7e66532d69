"""The operating point: quantities that may change while the twin runs."""

from __future__ import annotations

import math
from typing import NamedTuple

from .quantity import Section, bounds, quantity, unit_of, within


class OperatingPoint(Section):
    """Set-points and wear; every field can be changed at any simulated time.

    The drive of a scene limits speeds and torques further: see `Scene.tunables`.
    """

    backlash: float = quantity("m", "total backlash along the line of action", ge=0.0, le=1e-3)
    lambda_ratio: float = quantity(
        "",
        "specific film thickness (film/composite roughness), if the scene prescribes it",
        1.0,
        ge=0.0,
        le=10.0,
    )
    oil_temperature: float = quantity(
        "K",
        "oil temperature, which determines the viscosity; a state with `thermal`",
        343.15,
        ge=233.15,
        le=433.15,
    )
    ambient_temperature: float = quantity(
        "K", "temperature of the ambient air, for `thermal`", 293.15, ge=233.15, le=353.15
    )
    input_speed: float = quantity(
        "rad/s",
        "speed set-point of the motor, approached at the slew rate of the drive",
        limited_by="drive.speed_limit",
        ge=-1e5,
        le=1e5,
    )
    second_input_speed: float = quantity(
        "rad/s",
        "speed set-point of the second motor of a differential",
        0.0,
        limited_by="drive.speed_limit",
        ge=-1e5,
        le=1e5,
    )
    input_torque: float = quantity(
        "N m",
        "mean torque of the motor in steady running",
        limited_by="drive.torque_limit",
        ge=-1e9,
        le=1e9,
    )
    torque_ripple: float = quantity(
        "N m",
        "amplitude of the motor's torque ripple",
        0.0,
        limited_by="drive.torque_limit",
        ge=0.0,
        le=1e9,
    )


class Tunable(NamedTuple):
    """Description of one field of the operating point."""

    name: str
    """Name of the field."""
    unit: str
    """SI unit; empty for a dimensionless number."""
    description: str
    """Description in words."""
    minimum: float
    """Smallest allowed value, in SI."""
    maximum: float
    """Largest allowed value, in SI."""

    @property
    def range(self) -> str:
        """Description of the range."""
        return within(self.minimum, self.maximum, self.unit)

    def within(self, limit: float) -> Tunable:
        """The description with a further limit.

        Args:
            limit: largest allowed magnitude, in SI.

        Returns:
            The description with the smaller of both ranges.
        """
        return self._replace(minimum=max(self.minimum, -limit), maximum=min(self.maximum, limit))


def _tunables() -> dict[str, Tunable]:
    return {
        name: Tunable(name, unit_of(field) or "", field.description or "", *bounds(field))
        for name, field in OperatingPoint.model_fields.items()
    }


TUNABLES: dict[str, Tunable] = _tunables()

assert all(math.isfinite(t.minimum) and math.isfinite(t.maximum) for t in TUNABLES.values())
