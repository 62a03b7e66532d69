"""Local faults: faulty teeth of a gear, displaced pins, and pits in bearings."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import (
    Discriminator,
    Field,
    Tag,
    ValidationInfo,
    field_validator,
    model_validator,
)

from .errors import LARGEST
from .growth import Archard, Growth, LawGrowth, Paris, Table
from .quantity import Section, bounds, kind, quantity

MOST_FAULTS = 64
SPALL_EDGE = 0.02  # base pitches over which a contact line enters or leaves a spall


class AnyFault(Section):
    """A fault with severities: fields that may change while the twin runs."""

    SEVERITIES: ClassVar[tuple[str, ...]] = ()

    @property
    def severities(self) -> tuple[str, ...]:
        """Names of the fields that may change while the twin runs."""
        return self.SEVERITIES

    @property
    def growing(self) -> Growth | None:
        """How it grows, None if it does not."""
        return getattr(self, "growth", None)


class ToothFault(AnyFault):
    """Faulty tooth: teeth are numbered from 0, the tooth that meets planet 1 first.

    A tooth of a planet meets the sun and the ring with opposite flanks.
    """

    gear: Literal["sun", "planet", "ring"] = Field(description="gear with the faulty tooth")
    planet: int = Field(1, ge=1, le=7, description="number of the planet, if gear is planet")
    tooth: int = Field(
        0, ge=0, le=2999, description="number of the tooth; 0 is the one that meets planet 1 first"
    )


def _growth() -> Any:
    return Field(None, description="growth of the severity while the twin runs")


class Crack(ToothFault):
    """A crack at the root, which reduces the stiffness for both flanks in every mesh."""

    kind: Literal["crack"] = Field(description="a crack at the root")
    stiffness_loss: float | None = quantity(
        "", "relative stiffness loss of a pair with this tooth", None, ge=0.0, le=0.9
    )
    depth: float | None = quantity(
        "m", "length of the crack, from which the loss is computed", None, ge=0.0, le=0.1
    )
    angle: float = quantity(
        "rad",
        "angle between the crack and the centre line of the tooth",
        math.radians(70.0),
        ge=0.5,
        le=1.58,
    )
    growth: Growth | None = _growth()

    @property
    def severities(self) -> tuple[str, ...]:
        """The field that is given."""
        return ("stiffness_loss",) if self.depth is None else ("depth",)

    @model_validator(mode="after")
    def _one_measure(self) -> Self:
        if (self.stiffness_loss is None) == (self.depth is None):
            raise ValueError("stiffness_loss, depth: a crack needs exactly one of them")
        if isinstance(self.growth, Archard):
            raise ValueError("growth.law = 'archard': a crack grows by paris or a table")
        return _checked(self)


class FlankFault(ToothFault):
    """A fault of one flank."""

    flank: Literal["drive", "coast"] = Field(
        "drive", description="drive: the flank that is loaded if the torque on the sun is positive"
    )
    mesh: Literal["sun", "ring"] = Field("sun", description="mesh of a planet with the fault")


class Spall(FlankFault):
    """A pit in the flank, where part of the face width carries no load."""

    SEVERITIES = ("stiffness_loss",)

    kind: Literal["spall"] = Field(description="a pit in a flank")
    begin: float = quantity(
        "", "start on the path of contact [base pitches]", -0.1, ge=-2.0, le=2.0
    )
    end: float = quantity("", "end on the path of contact [base pitches]", 0.1, ge=-2.0, le=2.0)
    stiffness_loss: float = quantity("", "relative stiffness loss in this range", ge=0.0, le=0.9)
    growth: Growth | None = _growth()

    @model_validator(mode="after")
    def _runs_forwards(self) -> Self:
        if not self.end - self.begin >= 2.0 * SPALL_EDGE:
            raise ValueError(f"end = {self.end:g}: must be at least begin + {2.0 * SPALL_EDGE:g}")
        if self.growth is not None and not isinstance(self.growth, Table):
            raise ValueError(f"growth.law = {self.growth.law!r}: a spall grows by a table")
        return _checked(self)


class Wear(FlankFault):
    """Uniformly worn flanks, which increase the backlash while they alone are in contact."""

    SEVERITIES = ("depth",)

    kind: Literal["wear"] = Field(description="a worn flank, or all flanks of a gear")
    planet: Annotated[int, Field(ge=1, le=7)] | Literal["all"] = Field(  # type: ignore[assignment]
        1, description="number of the planet, if gear is planet; all: all planets"
    )
    tooth: Annotated[int, Field(ge=0, le=2999)] | Literal["all"] = Field(  # type: ignore[assignment]
        0, description="number of the tooth; all: all teeth of the gear"
    )
    depth: float = quantity("m", "worn depth along the line of action", ge=0.0, le=1e-3)
    growth: Growth | None = _growth()

    @field_validator("planet", "tooth", mode="before")
    @classmethod
    def _number_or_all(cls, value: object, info: ValidationInfo) -> object:
        low, high = (1, 7) if info.field_name == "planet" else (0, 2999)
        number = int(value) if isinstance(value, str) and value.isdecimal() else value
        if value == "all" or (isinstance(number, int) and low <= number <= high):
            return number
        raise ValueError(f"must be a whole number within {low} and {high}, or all")

    @model_validator(mode="after")
    def _grows_by_its_law(self) -> Self:
        if isinstance(self.growth, Paris):
            raise ValueError("growth.law = 'paris': wear grows by archard or a table")
        return _checked(self)


class Pitch(AnyFault):
    """Single pitch deviations of one flank of all teeth of a gear, which repeat with its turns.

    A tooth that stands out from its neighbours carries load before them. `backlash` is that of the
    tooth that stands out most.
    """

    SEVERITIES = ("scale",)

    kind: Literal["pitch"] = Field(description="single pitch deviations")
    gear: Literal["sun", "planet", "ring"] = Field(description="gear with the deviations")
    planet: int = Field(1, ge=1, le=7, description="number of the planet, if gear is planet")
    flank: Literal["drive", "coast"] = FlankFault.model_fields["flank"]  # type: ignore[assignment]
    mesh: Literal["sun", "ring"] = FlankFault.model_fields["mesh"]  # type: ignore[assignment]
    deviations: tuple[float, ...] = quantity(
        "m", "of each tooth against the tooth before it, positive towards the flanks of the mate; "
        "their mean is subtracted", (), max_length=3000,
    )  # fmt: skip
    grade: int | None = Field(
        None, ge=1, le=11, description="flank tolerance class (ISO 1328-1:2013) of drawn deviations"
    )
    seed: int = Field(0, ge=0, le=999_999, description="seed of the drawn deviations")
    scale: float = quantity("", "factor on the deviations", 1.0, ge=0.0, le=100.0)

    @model_validator(mode="after")
    def _one_source(self) -> Self:
        if bool(self.deviations) == (self.grade is not None):
            raise ValueError("deviations, grade: pitch deviations need exactly one of them")
        if self.deviations and not max(map(abs, self.deviations)) <= 1e-3:
            raise ValueError("deviations: each must be within -0.001 and 0.001 m")
        return self


class Pin(AnyFault):
    """A displaced pin, in addition to those of `errors`."""

    SEVERITIES = ("radial", "tangential")

    kind: Literal["pin"] = Field(description="a displaced pin")
    planet: int = Field(1, ge=1, le=7, description="number of the planet")
    radial: float = quantity("m", "displacement outwards", 0.0, ge=-LARGEST, le=LARGEST)
    tangential: float = quantity(
        "m", "displacement counter-clockwise", 0.0, ge=-LARGEST, le=LARGEST
    )


class Bearing(AnyFault):
    """A pit in a race or in a roller of a rolling bearing, into which elements drop.

    The inner race of a planet bearing is on the pin, its outer race in the bore of the planet. The
    inner races of the other bearings turn with their bodies. Elements do not slip.
    """

    SEVERITIES = ("depth",)

    kind: Literal["bearing"] = Field(description="a pit in a rolling bearing")
    bearing: Literal["planet", "sun", "ring", "carrier"] = Field(
        "planet", description="body on the bearing, which needs `rolling` in its support"
    )
    planet: int = Field(1, ge=1, le=7, description="number of the planet, if bearing is planet")
    element: Literal["inner", "outer", "roller"] = Field(
        description="part with the pit: inner race, outer race, or one roller or ball"
    )
    ratio: float = quantity(
        "", "diameter of a roller over that of their pitch circle, times the cosine of the contact "
        "angle", gt=0.0, lt=1.0,
    )  # fmt: skip
    depth: float = quantity("m", "depth by which an element drops", ge=0.0, le=1e-3)
    width: float = quantity(
        "rad", "angle that the pit takes up, about the axis of the bearing or of the roller",
        math.radians(3.0), ge=1e-4, le=2.0,
    )  # fmt: skip
    angle: float = quantity(
        "rad", "angle of the pit or of the roller at the start, counter-clockwise from the middle "
        "of the load zone of a planet, and from x of the other bearings", 0.0, ge=-6.3, le=6.3,
    )  # fmt: skip
    growth: Growth | None = _growth()

    @model_validator(mode="after")
    def _grows_by_times(self) -> Self:
        if self.growth is not None and not (isinstance(self.growth, Table) and self.growth.time):
            raise ValueError("growth: a pit of a bearing grows by a table of times")
        return _checked(self)


Fault = Annotated[
    Annotated[Crack, Tag("crack")]
    | Annotated[Spall, Tag("spall")]
    | Annotated[Wear, Tag("wear")]
    | Annotated[Pitch, Tag("pitch")]
    | Annotated[Pin, Tag("pin")]
    | Annotated[Bearing, Tag("bearing")],
    Discriminator(kind),
]


def _checked(fault: Any) -> Any:
    """The fault; raises `ValueError` if it cannot reach the end of its growth."""
    growth, (name,) = fault.growth, fault.severities
    if growth is None:
        return fault
    if isinstance(growth, LawGrowth):
        if name != "depth":
            raise ValueError(f"growth.law = {growth.kind!r}: requires a depth")
        if growth.until < fault.depth:
            raise ValueError(f"growth.until = {growth.until:g} m: must be at least depth")
    elif not getattr(growth, name):
        raise ValueError(f"growth: requires {name}, as the fault has")
    elif growth.severities[0] != getattr(fault, name):
        raise ValueError(f"growth.{name}: must begin with {name} = {getattr(fault, name):g}")
    low, high = bounds(type(fault).model_fields[name])
    worst = [at for at in (growth.last,) if not low <= at <= high]
    worst += [at for at in getattr(growth, "severities", ()) if not low <= at <= high]
    if worst:
        raise ValueError(f"growth: {name} = {worst[0]:g}: must be within {low:g} and {high:g}")
    return fault


def distinct_planet(fault: Fault) -> int | None:
    """Number of the planet that a fault distinguishes from the others, whatever its severity."""
    if isinstance(fault, Pin):
        return fault.planet
    if isinstance(fault, Bearing):
        return fault.planet if fault.bearing == "planet" else None
    return fault.planet if fault.gear == "planet" and fault.planet != "all" else None


def is_of_central_bearing(fault: Fault) -> bool:
    """Whether a fault displaces sun, ring or carrier in their bearings, and so all planets."""
    return isinstance(fault, Bearing) and fault.bearing != "planet"


def without_pits(faults: Sequence[Fault]) -> tuple[Fault, ...]:
    """Faults that dynamics without deflected bearings have."""
    return tuple(fault for fault in faults if not isinstance(fault, Bearing))


def is_of_some_teeth(fault: Fault, gear: str) -> bool:
    """Whether a fault distinguishes teeth of a gear from its other teeth."""
    return getattr(fault, "gear", "") == gear and getattr(fault, "tooth", 0) != "all"
