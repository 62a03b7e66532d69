"""Motors, load and speed control."""

from __future__ import annotations

from typing import Self

from pydantic import Field, model_validator

from .gearset import Member
from .quantity import Section, quantity


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
