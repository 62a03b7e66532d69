"""What a data set consists of, from a YAML file."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any, Literal, Self

from pydantic import Field, model_validator

from ..scene import Scene, SceneError, load_scene, packaged_scenes
from ..scene.quantity import Section, quantity
from ..scene.yaml_file import read_section

MOST_RECORDS = 100_000
LONGEST = 600.0  # [s] of a record
STEP = 0.01  # [s] between commands, between which speed and torque change linearly
ROUNDING = 1e-6  # of shares that add up to 1


class Splits(Section):
    """Shares of the specimens, each of which has all its records in one part."""

    by: Literal["specimen"] = Field("specimen", description="what is never in two parts")
    train: float = quantity("", "share of the specimens to learn from", 0.6, ge=0.0, le=1.0)
    validation: float = quantity("", "share to choose settings with", 0.2, ge=0.0, le=1.0)
    test: float = quantity("", "share to judge with", 0.2, ge=0.0, le=1.0)

    @property
    def shares(self) -> dict[str, float]:
        """Shares by the name of the part."""
        return {"train": self.train, "validation": self.validation, "test": self.test}

    @model_validator(mode="after")
    def _add_up(self) -> Self:
        total = math.fsum(self.shares.values())
        if abs(total - 1.0) > ROUNDING:
            raise ValueError(f"train + validation + test = {total:g}: must be 1")
        return self


class Course(Section):
    """How speed and torque change within a record; a value may be a distribution."""

    speed_wander: float = quantity(
        "", "standard deviation of the random course of the speed over the speed", 0.0,
        ge=0.0, le=0.2,
    )  # fmt: skip
    torque_wander: float = quantity(
        "", "standard deviation of the random course of the torque over the torque", 0.0,
        ge=0.0, le=0.5,
    )  # fmt: skip
    wander_time: float = quantity(
        "s", "time T of both: their autocorrelation is (1 + t/T) exp(-t/T)", 0.2, ge=0.02, le=1e3
    )
    speed_ramp: float = quantity(
        "", "change of the speed from start to end of the record over its mean", 0.0,
        ge=-1.0, le=1.0,
    )  # fmt: skip

    @property
    def steady(self) -> bool:
        """Whether speed and torque are constant."""
        return not (self.speed_wander or self.torque_wander or self.speed_ramp)


class DatasetSpec(Section):
    """A scene, specimens of it, their faults, and the records that are taken of each."""

    name: str = Field(pattern=r"^[a-z0-9][a-z0-9_-]{0,95}$", description="of the data set")
    description: str = Field("", description="in words, for the card of the data set")
    license: str = Field(
        "cc-by-4.0", pattern=r"^[a-z0-9][a-z0-9.-]*$",
        description="licence of the data, as Hugging Face names it",
    )  # fmt: skip
    version: str = Field("1.0.0", pattern=r"^\d+\.\d+\.\d+$", description="of the data set")
    creators: tuple[str, ...] = Field((), description="names, for the metadata")
    url: str | None = Field(None, pattern=r"^https?://\S+$", description="page of the data set")
    published: str | None = Field(
        None, pattern=r"^\d{4}-\d{2}-\d{2}$", description="date of publication, quoted"
    )
    scene: str = Field(description="packaged scene, or a YAML file beside this one")
    set: dict[str, Any] = Field(
        {}, description="fields of the scene that differ in all records, by dotted name"
    )
    specimens: int = Field(ge=1, le=MOST_RECORDS, description="number of gearboxes")
    drawn: dict[str, Any] = Field(
        {}, description="fields that are drawn for each specimen, by dotted name"
    )
    faults: tuple[Any, ...] = Field(
        (), max_length=100,
        description="faulty states of each specimen, in addition to the healthy one: a fault, or a "
        "list of faults at the same time, with the fields of scene.faults and `label`",
    )  # fmt: skip
    operating_points: tuple[dict[str, Any], ...] = Field(
        (), max_length=1000,
        description="quantities of the operating point that differ from the scene, and fields of "
        "the course of speed and torque; none: that of the scene",
    )  # fmt: skip
    repetitions: int = Field(1, ge=1, le=MOST_RECORDS, description="of each state and point")
    duration: float = quantity("s", "length of a record", 1.0, gt=0.0, le=LONGEST)
    settling: float = quantity("s", "simulated time before", 0.2, ge=0.0, le=LONGEST)
    tolerance: float = quantity(
        "", "relative local error tolerance of the integrator", 1e-4, ge=1e-10, le=1e-2
    )
    seed: int = Field(0, ge=0, lt=2**63, description="of all random numbers")
    splits: Splits = Field(Splits(), description="parts, by specimen")
    mcap: bool = Field(False, description="whether each run is recorded as MCAP, too")

    @property
    def points(self) -> tuple[dict[str, Any], ...]:
        """Operating points, at least one."""
        return self.operating_points or ({},)

    @property
    def records_per_specimen(self) -> int:
        """Healthy and faulty ones."""
        return (1 + len(self.faults)) * len(self.points) * self.repetitions

    @property
    def records(self) -> int:
        """Number of records."""
        return self.specimens * self.records_per_specimen

    @model_validator(mode="after")
    def _recorded_at_once(self) -> Self:
        if self.mcap and abs(round(self.settling / STEP) * STEP - self.settling) > 1e-12:
            raise ValueError(
                f"settling = {self.settling:g} s: must be a multiple of {STEP:g} s with mcap"
            )
        return self

    @model_validator(mode="after")
    def _not_too_many(self) -> Self:
        if self.records > MOST_RECORDS:
            raise ValueError(
                f"specimens x (1 + faults) x operating_points x repetitions = {self.records}: "
                f"must be at most {MOST_RECORDS} records"
            )
        return self


def read_spec(path: Path) -> tuple[DatasetSpec, Scene]:
    """Read the specification of a data set, and its scene.

    Args:
        path: YAML file with the fields of `DatasetSpec`.

    Returns:
        The specification, and the scene that all specimens derive from.

    Raises:
        SceneError: the file is not in YAML, or a field is invalid; the message starts with the
            path.
        OSError: the file cannot be read.
    """
    spec = read_section(path, DatasetSpec)
    packaged = spec.scene in packaged_scenes()
    try:
        scene = load_scene(spec.scene if packaged else path.parent / spec.scene)
        return spec, scene.replace(**spec.set)
    except SceneError as error:
        raise SceneError(f"{path}: {error}") from None
