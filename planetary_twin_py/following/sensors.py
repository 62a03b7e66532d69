"""Sensors of a measured gearbox: noise, and uncertainty of zero and gain."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path

from pydantic import Field

from ..scene.quantity import Section, quantity
from ..scene.yaml_file import read_section
from ..sensors.converter import ErrorModel
from .channels.all import CHANNELS
from .train import FollowedTrain

FULL_SCALE = 1.6  # default full scale over the torque of the operating point
CLASS = 1e-3  # accuracy class 0.1 of a torque transducer


class TorqueSensor(Section):
    """A torque transducer, by default of class 0.1 with 1.6 times the torque of the scene."""

    noise: float | None = quantity(
        "N m", "standard deviation of a reading; default: 0.1 % of full scale", None, gt=0, le=1e8
    )
    zero: float | None = quantity(
        "N m", "standard deviation of the zero; default: 0.05 % of full scale", None, gt=0, le=1e8
    )
    gain: float = quantity("", "standard deviation of the gain", CLASS, gt=0.0, le=1.0)


class Encoders(Section):
    """Two encoders on the members of input and output, read by one device."""

    input_counts: int = Field(2**20, ge=1, le=2**32, description="per turn of the input")
    output_counts: int = Field(2**20, ge=1, le=2**32, description="per turn of the output")
    rate: float = quantity("Hz", "samples per second", 20_000.0, gt=0.0, le=1e7)


class JointNames(Section):
    """Names of joints and topics of measured joint states."""

    input: str = Field("input_joint", description="joint of the input shaft")
    output: str = Field("output_joint", description="joint of the output shaft")
    topics: str = Field("joint_states", description="last part of the names of topics to read")


class PlanetBearing(Section):
    """Rolling elements of the bearing of a planet."""

    rollers: int = Field(ge=3, le=1000, description="number of rolling elements")
    ratio: float = quantity(
        "", "diameter of an element over the pitch diameter, times the cosine of the contact angle",
        gt=0.0, lt=1.0,
    )  # fmt: skip


class Sensors(Section):
    """Accuracy of the sensors, and the inertia between them."""

    input_torque: TorqueSensor = Field(TorqueSensor(), description="at the input shaft")
    output_torque: TorqueSensor = Field(TorqueSensor(), description="at the output shaft")
    inertia: float | None = quantity(
        "kg m^2",
        "moment of inertia between both torque sensors, referred to the input; default: that of "
        "the whole train with motor and load",
        None,
        ge=0.0,
        le=1e9,
    )
    friction: float = quantity(
        "", "standard deviation of the friction level, whose prior mean is 1", 0.5, gt=0, le=10
    )
    drag: float | None = quantity(
        "N m",
        "standard deviation of a drag at the input that the scene lacks; default: 0.075 % of the "
        "torque of the scene",
        None,
        gt=0.0,
        le=1e8,
    )
    encoders: Encoders = Field(Encoders(), description="on the input and the output member")
    joints: JointNames = Field(JointNames(), description="in recordings")
    planet_bearing: PlanetBearing | None = Field(
        None, description="whose faults vibration may show"
    )
    columns: dict[str, str] = Field({}, description="heading of a channel in tables, by channel")
    scale: dict[str, float] = Field({}, description="factor on readings, by channel")
    learning: int = Field(
        24, ge=8, le=10_000, description="hunting periods from which a baseline is learned"
    )

    @property
    def rolling(self) -> tuple[int, Fraction] | None:
        """Number of rolling elements of a planet bearing, and their ratio; None if unknown."""
        given = self.planet_bearing
        return None if given is None else (given.rollers, Fraction(repr(given.ratio)))


def read_sensors(path: Path) -> Sensors:
    """Read a YAML file with fields of `Sensors`.

    Raises `SceneError` for an invalid one.
    """
    return read_section(path, Sensors)


def inertia_between(sensors: Sensors, train: FollowedTrain) -> float:
    """Moment of inertia between both torque sensors, referred to the input [kg m^2]."""
    return train.inertia if sensors.inertia is None else sensors.inertia


def check_scale(scale: Mapping[str, float]) -> None:
    """Raise `ValueError` where a channel of factors does not exist, or one is out of range."""
    for name, factor in scale.items():
        if name not in CHANNELS:
            raise ValueError(f"scale: {name!r}: must be one of {', '.join(CHANNELS)}")
        if not 1e-9 <= abs(factor) <= 1e9:
            raise ValueError(f"scale: {name} = {factor!r}: its magnitude must be 1e-9 to 1e9")


def torque_errors(sensors: Sensors, train: FollowedTrain) -> tuple[ErrorModel, ErrorModel]:
    """Standard deviations of the errors of the torque sensors at the input and at the output."""
    full_scale = FULL_SCALE * train.torque
    at_input, at_output = (
        ErrorModel(given.noise or CLASS * scale, given.zero or 0.5 * CLASS * scale, given.gain)
        for given, scale in (
            (sensors.input_torque, full_scale),
            (sensors.output_torque, full_scale / abs(train.ratio)),
        )
    )
    return at_input, at_output


def balance_errors(sensors: Sensors, train: FollowedTrain) -> ErrorModel:
    """Standard deviations of the errors of the sum of both torques, referred to the input."""
    at_input, at_output = torque_errors(sensors, train)
    return ErrorModel(
        float((at_input.noise**2 + (train.ratio * at_output.noise) ** 2) ** 0.5),
        float((at_input.zero**2 + (train.ratio * at_output.zero) ** 2) ** 0.5),
        float((at_input.gain**2 + at_output.gain**2) ** 0.5),
    )


def torque_change(sensors: Sensors, train: FollowedTrain) -> tuple[float, float]:
    """Change of a single reading of each torque that only a change of the load explains [N m]."""
    at_input, at_output = torque_errors(sensors, train)
    load = 0.02 * train.torque
    return max(load, 8.0 * at_input.noise), max(load / abs(train.ratio), 8.0 * at_output.noise)
