"""Sensors on a gearbox: where they are, what they hear, and how they record it."""

from __future__ import annotations

import math
from typing import Annotated, Literal

from pydantic import Discriminator, Field, Tag

from .quantity import Section, quantity

MOST_WAVES = 12


class TransferWindow(Section):
    """A path whose gain depends on how far a planet is from the sensor.

    The sensor hears the alternating force of each ring mesh, weighted by a window of the angle
    between planet and sensor (McFadden and Smith 1985; Inalpolat and Kahraman 2009). Its gain is
    that of no real housing: ratios of lines are results, levels are not.
    """

    law: Literal["window"] = Field("window", description="force of each ring mesh times a window")
    shape: Literal["cosine", "hann", "exponential"] = Field(
        "cosine",
        description="cosine: cos^(2 power) of half the angle d from the sensor; hann: one lobe, as "
        "wide as the distance of neighbouring planets; exponential: "
        "(0.54 + 0.46 cos d) exp(-decay d^2)",
    )
    power: int = Field(4, ge=1, le=50, description="of shape: cosine")
    decay: float = quantity("", "of shape: exponential [1/rad^2]", 0.1, ge=0.0, le=100.0)
    direct: float = quantity(
        "",
        "constant share of the force of each ring mesh, which arrives through bearings and shafts, "
        "in addition to the window",
        0.0,
        ge=0.0,
        le=10.0,
    )
    gain: float = quantity(
        "m/s^2/N", "acceleration of the sensor over the force of a mesh beside it", 0.01,
        gt=0.0, le=1e6,
    )  # fmt: skip


class FlexibleRing(Section):
    """Bending of a thin ring that is free but for its mounting (Hoppe 1871; Love 1927)."""

    law: Literal["flexible"] = Field(description="bending vibration of the rim of the ring")
    radius: float = quantity("m", "of the centre line of the rim", gt=0.0, le=50.0)
    area: float = quantity("m^2", "of the cross-section of the rim", gt=0.0, le=10.0)
    second_moment: float = quantity(
        "m^4", "of the cross-section, for bending in the plane", gt=0.0, le=10.0
    )
    waves: int = Field(6, ge=2, le=MOST_WAVES, description="largest number of waves around the rim")
    damping_ratio: float = quantity("", "of each mode", 0.02, ge=0.001, lt=1.0)
    density: float = quantity("kg/m^3", "of the rim", 7850.0, gt=0.0, le=30_000.0)
    youngs_modulus: float = quantity("Pa", "of the rim", 2.06e11, gt=0.0, le=1e12)
    mounting: float = quantity(
        "N/m", "stiffness of springs all around the rim, in the radial direction", 0.0,
        ge=0.0, le=1e14,
    )  # fmt: skip


def _law(path: object) -> object:
    if isinstance(path, dict):
        return path.get("law", "window")
    return getattr(path, "law", None)


TransferPath = Annotated[
    Annotated[TransferWindow, Tag("window")] | Annotated[FlexibleRing, Tag("flexible")],
    Discriminator(_law),
]


class Accelerometer(Section):
    """An accelerometer on the housing, above the ring.

    A filter in front of the sampling passes 0.4 of the rate and stops what would be an alias.
    """

    name: str = Field("ring", pattern=r"^[a-z][a-z0-9_]*$", description="name of the sensor")
    angle: float = quantity(
        "rad", "place on the housing, counter-clockwise as planet_angles", math.radians(90.0),
        ge=-10.0, le=10.0,
    )  # fmt: skip
    rate: float = quantity("Hz", "sample rate", 25_600.0, gt=0.0, le=1e6)
    path: TransferPath = Field(TransferWindow(), description="path from the teeth to the sensor")
    resonance: float | None = quantity(
        "Hz", "natural frequency of the sensor on its mounting; none: above all frequencies", None,
        gt=0.0, le=1e6,
    )  # fmt: skip
    damping_ratio: float = quantity("", "of the resonance of the sensor", 0.02, ge=0.005, lt=1.0)
    range: float | None = quantity(
        "m/s^2", "largest magnitude; larger ones are clipped; none: no limit and no bits", None,
        gt=0.0, le=1e7,
    )  # fmt: skip
    bits: int = Field(24, ge=8, le=32, description="of the converter, over twice the range")
    noise: float = quantity("m/s^2", "standard deviation of a sample", 0.05, ge=0.0, le=1e6)
    seed: int = Field(0, ge=0, description="of the random numbers of the noise")
