"""Changes of a plant, and its duty."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from ..scene.faults import MOST_FAULTS, Fault
from ..scene.quantity import Section, quantity


class Change(Section):
    """A change at an instant.

    A value replaces the one before and does not add to it. Quantities that are not given do not
    change.
    """

    at: float = quantity("s", "time of the change", ge=0.0, le=1e9)
    friction: float | None = quantity(
        "", "factor on the tooth friction of the scene", None, gt=0.0, le=100.0
    )
    drag: float | None = quantity(
        "N m", "drag at the input in addition to the losses of the scene", None, ge=0.0, le=1e6
    )
    torque_zero: float | None = quantity(
        "N m",
        "zero of the torque sensor at the input, in place of that of sensors",
        None,
        ge=-1e6,
        le=1e6,
    )
    load: float | None = quantity("", "factor on the torque of the duty", None, ge=-10.0, le=10.0)
    faults: tuple[Fault, ...] | None = Field(
        None,
        max_length=MOST_FAULTS,
        description="all faulty teeth from this time on; [] repairs them",
    )


class Duty(Section):
    """Course of torque and speed at the input."""

    kind: Literal["steady", "varied", "reversing", "four_quadrant"] = Field(
        "steady",
        description="steady: the operating point of the scene; varied: another torque and speed "
        "every 5 s; reversing: the torque changes its sign every 5 s; four_quadrant: the "
        "speed also changes its sign, every 10 s",
    )
    torque_wander: float = quantity(
        "", "standard deviation of its random changes over the torque", 0.03, ge=0
    )
    speed_wander: float = quantity(
        "", "standard deviation of its random changes over the speed", 0.003, ge=0
    )
