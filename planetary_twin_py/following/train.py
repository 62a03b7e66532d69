"""Data of a gear train that the followers need: ratios, inertia, hunting period."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import NamedTuple

from ..analysis.faults.turning import Turning, turning_of
from ..model.layout import Layout
from ..scene import Scene, SceneError


class FollowedTrain(NamedTuple):
    """A train with one input and one output."""

    ratio: float
    """Speed of the output over that of the input, signed."""
    inertia: float
    """Moment of inertia of the whole train with motor and load, referred to the input [kg m^2]."""
    torque: float
    """Magnitude of the input torque of the scene [N m]; a tenth of its limit if it is zero."""
    speed: float
    """Magnitude of the input speed of the scene [rad/s]; a tenth of its limit if it is zero."""
    speed_limit: float
    """Largest speed of the input [rad/s]."""
    torque_limit: float
    """Largest torque of a motor [N m]."""
    oil_temperature: float
    """Oil temperature of the scene [K]."""
    members: tuple[str, str]
    """The member that the motor drives, and the member that drives the load."""
    cycles: Fraction
    """Mesh cycles per turn of the input, signed."""
    twist: tuple[Fraction, Fraction]
    """Turns of the sun (the ring, if the sun is held) per turn of the input and of the output."""
    lever: float
    """Base radius of that gear [m], which converts a twist to a transmission error."""
    teeth: dict[str, int]
    """Number of teeth by the name of the gear, "sun", "planet_1", ..., "ring"."""
    turning: Turning
    """How often members turn, and where faults have lines."""

    @property
    def hunting_cycles(self) -> int:
        """Mesh cycles after which every tooth meets the same teeth again."""
        return math.lcm(*self.teeth.values())


def followed_train(scene: Scene) -> FollowedTrain:
    """Data of a scene that the followers need.

    Raises `SceneError` if it has two inputs.
    """
    if scene.drive.second_input is not None:
        raise SceneError("drive.second_input: a differential cannot be followed")
    layout = Layout(scene)
    ratios = {name: ratio[0] for name, ratio in layout.ratios.items()}
    members = (scene.drive.input.member, scene.drive.output.member)
    gear = "ring" if scene.gearset.held == "sun" else "sun"
    point, numbers = scene.operating_point, scene.gearset.tooth_numbers
    planets = {f"planet_{n + 1}": numbers.planet for n in range(scene.gearset.planets)}
    return FollowedTrain(
        ratio=float(ratios[members[1]]),
        inertia=_inertia(layout),
        torque=abs(point.input_torque) or 0.1 * scene.drive.torque_limit,
        speed=abs(point.input_speed) or 0.1 * scene.drive.speed_limit,
        speed_limit=scene.drive.speed_limit,
        torque_limit=scene.drive.torque_limit,
        oil_temperature=point.oil_temperature,
        members=members,
        cycles=layout.cycles[0],
        twist=(ratios[gear], ratios[gear] / ratios[members[1]]),
        lever=layout.radii[gear],
        teeth={"sun": numbers.sun, **planets, "ring": numbers.ring},
        turning=turning_of(scene),
    )


def _inertia(layout: Layout) -> float:
    """Moment of inertia of all bodies, referred to the input [kg m^2]."""
    copies = {"planet": len(layout.planets)}
    parts = {
        kind: mass * layout.radii[kind] ** 2 * copies.get(kind, 1)
        for kind, mass in layout.masses.items()
    } | {name: machine.inertia for name, machine in layout.machines.items()}
    return sum(inertia * float(layout.ratios[name][0]) ** 2 for name, inertia in parts.items())
