"""Motors, load and speed control."""

from __future__ import annotations

from typing import Literal, NamedTuple, Self

from pydantic import Field, model_validator

from .gearset import Member
from .quantity import Section, quantity

Causality = Literal["machine", "torque", "motion", "brake"]
MOVED = ("motion", "brake")
"""Causalities with which the motion of a shaft is given, and its torque is a result."""


class Ports(NamedTuple):
    """What acts on the shafts of input and output, see `Machine.port`."""

    input: Causality = "machine"
    """At the shaft of the motor."""
    output: Causality = "machine"
    """At the shaft of the load."""

    @property
    def given(self) -> bool:
        """Whether torque or motion is given at a port."""
        return self != Ports()

    @property
    def hold_speed(self) -> bool:
        """Whether machines hold the speed set-point.

        A machine does unless the motion of the other shaft is given: then it only gives its torque.
        """
        return "machine" in self and not any(port in MOVED for port in self)

    @property
    def hold_second_speed(self) -> bool:
        """Whether the second motor of a differential holds its speed set-point.

        It does unless the motions of both other shafts are given, which determine its speed.
        """
        return not all(port in MOVED for port in self)

    @property
    def braked(self) -> Ports:
        """The ports while a brake stops the input: an output with a client is free of torque."""
        return Ports("brake", "machine" if self.output == "machine" else "torque")


class Machine(Section):
    """Motor or load, coupled elastically to a member of the gearset."""

    member: Member = Field(description="member of the gearset to which it is coupled")
    inertia: float = quantity("kg m^2", "moment of inertia", gt=0.0, le=1e9)
    coupling_stiffness: float = quantity(
        "N m/rad", "stiffness of the shaft coupling to the member", gt=0.0, le=1e12
    )
    coupling_damping: float = quantity(
        "N m s/rad", "damping of the shaft coupling to the member", ge=0.0, le=1e9
    )
    port: Causality = Field(
        "machine",
        description="input at the shaft: machine, a motor or load with its controller; torque, "
        "given from outside, the speed is a result; motion, given from outside, the torque is a "
        "result (the inertia is then not part of the train); brake, of the input only, slows "
        "the shaft down to rest at the slew rate of the drive and ends a given output torque",
    )


class SpeedControl(Section):
    """Speed control of the drive, and its torque ripple."""

    bandwidth: float | None = quantity(
        "Hz",
        "bandwidth of the speed loop; default: 3 Hz, or less for soft couplings or large inertias",
        None,
        gt=0.0,
        le=100.0,
    )
    slew_rate: float = quantity(
        "rad/s^2", "slew rate of the speed set-point", 500.0, gt=0.0, le=1e6
    )
    start_speed: float | None = quantity(
        "rad/s",
        "speed of the first motor at time zero; default: that of the operating point",
        None,
        ge=-1e5,
        le=1e5,
    )
    ripple_order: int = Field(2, ge=1, le=100, description="torque cycles per turn of the motor")


class Drive(Section):
    """Power flow: motors at the inputs, a load at the output.

    A gearset with a fixed member has one input. A differential has two: both speeds are
    prescribed, and the torque of the second follows from that of the first.
    """

    input: Machine = Field(description="motor")
    second_input: Machine | None = Field(None, description="second motor, of a differential")
    output: Machine = Field(description="load")
    speed_control: SpeedControl = Field(SpeedControl(), description="speed control")
    speed_limit: float = quantity(
        "rad/s", "largest speed set-point of a motor", 1100.0, gt=0, le=1e5
    )
    torque_limit: float = quantity(
        "N m", "largest torque set-point of a motor", 1000.0, gt=0, le=1e9
    )

    interpolation: Literal["hold", "linear"] = Field(
        "hold",
        description="course of given torques and motions between commands: hold, constant from a "
        "command on; linear, along a straight line that reaches it at the end of its step",
    )

    @property
    def ports(self) -> Ports:
        """What acts on the shafts of input and output."""
        return Ports(self.input.port, self.output.port)

    @property
    def inputs(self) -> tuple[Machine, ...]:
        """The motors."""
        return (self.input,) if self.second_input is None else (self.input, self.second_input)

    @model_validator(mode="after")
    def _a_member_each(self) -> Self:
        taken: set[str] = set()
        for side in ("input", "second_input", "output"):
            machine = getattr(self, side)
            if machine is None:
                continue
            if machine.member in taken:
                raise ValueError(f"{side}.member = {machine.member!r}: already has a motor or load")
            taken.add(machine.member)
        return self
