"""Paths from the teeth to an accelerometer."""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, Literal, Self

from pydantic import Discriminator, Field, Tag, model_validator

from ..quantity import Section, quantity

MOST_WAVES = 12
MOST_POLES = 12
MOST_ROWS = 400
LEAST_SPACING = 10.0  # [Hz] of the frequencies of a table


class WindowShape(Section):
    """A window of the angle between a planet and a sensor."""

    law: str = Field(description="how the path depends on the place of a planet")
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


class TransferWindow(WindowShape):
    """A path whose gain depends on how far a planet is from the sensor.

    The sensor receives the alternating force of each ring mesh, weighted by a window of the angle
    between planet and sensor (McFadden and Smith 1985; Inalpolat and Kahraman 2009). Its gain is
    that of no real housing: ratios of lines are results, levels are not.
    """

    law: Literal["window"] = Field("window", description="force of each ring mesh times a window")


class ResolvedWindow(WindowShape):
    """A window times the part of the alternating force that acts along the axis of the sensor.

    The force of a mesh has the direction of its line of action, which turns with the planet (Parra
    and Molina Vicuna 2017).
    """

    law: Literal["resolved"] = Field(
        description="force of each ring mesh along the axis of the sensor, times a window"
    )


class Pole(Section):
    """A pair of complex poles: a mass on a spring with a damper."""

    frequency: float = quantity("Hz", "natural frequency", gt=0.0, le=1e6)
    damping_ratio: float = quantity("", "of the pole", 0.02, ge=0.001, lt=1.0)
    gain: float = quantity("", "far below the frequency", 1.0, ge=-1e6, le=1e6)


class TableRow(Section):
    """Response of a path at a frequency."""

    frequency: float = quantity("Hz", "of the row; they increase", ge=0.0, le=1e6)
    magnitude: float = quantity("", "factor on the gain", ge=0.0, le=1e6)
    phase: float = quantity("rad", "by which the acceleration leads", 0.0, ge=-1e3, le=1e3)


class FilteredWindow(WindowShape):
    """A window, then a response over frequency: the sum of some poles, or a table.

    Between rows of a table, magnitude and phase are interpolated linearly; below the first one they
    are those of the first.
    """

    law: Literal["filter"] = Field(description="as window, then a response over frequency")
    poles: tuple[Pole, ...] = Field((), max_length=MOST_POLES, description="poles of the response")
    table: tuple[TableRow, ...] = Field(
        (), max_length=MOST_ROWS, description="response at some frequencies, instead of poles"
    )

    @model_validator(mode="after")
    def _poles_or_table(self) -> Self:
        if bool(self.poles) == bool(self.table):
            raise ValueError("poles, table: a path with law filter needs exactly one of them")
        if len(self.table) == 1:
            raise ValueError("table: has 1 entry: must have at least 2")
        frequencies = [row.frequency for row in self.table]
        for n, (low, high) in enumerate(pairwise(frequencies), 1):
            if high - low < LEAST_SPACING:
                raise ValueError(
                    f"table.{n}.frequency = {high:g}: must be at least {LEAST_SPACING:g} Hz above "
                    f"that of the row before, {low:g} Hz"
                )
        return self


class RigidRing(Section):
    """A rigid ring on its bearing, for dynamics with moving axes and a held ring.

    The sensor shows the acceleration of the axis of the ring in the direction of the sensor, and,
    if that is tangential, that of its rotation at the radius of the sensor.
    """

    law: Literal["rigid"] = Field(description="acceleration of the ring on its bearing")
    radius: float | None = quantity(
        "m", "distance of the sensor from the axis; required with direction: tangential", None,
        gt=0.0, le=50.0,
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


def law(path: object) -> object:
    """Law of a path, by which its section is chosen."""
    if isinstance(path, dict):
        return path.get("law", "window")
    return getattr(path, "law", None)


TransferPath = Annotated[
    Annotated[TransferWindow, Tag("window")]
    | Annotated[ResolvedWindow, Tag("resolved")]
    | Annotated[FilteredWindow, Tag("filter")]
    | Annotated[RigidRing, Tag("rigid")]
    | Annotated[FlexibleRing, Tag("flexible")],
    Discriminator(law),
]
