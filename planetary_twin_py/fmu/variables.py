"""Variables of an FMU, with the same numbers in its description, its records and its library."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np

from .._core import POINT_FIELDS, Exported
from ..durability.parts import part_names
from ..model.gearbox import Gearbox
from ..model.layout import LOAD_MACHINE, MOTOR
from ..model.speed_loop_check import SpeedLoopCheck
from ..scene import OperatingPoint, Scene
from ..scene.drive import Causality
from ..scene.thermal import NODES
from ..units.catalogue import WAVEFORM


@dataclass(frozen=True)
class Variable:
    """A real variable; its index in the list of variables is its value reference."""

    name: str
    """Name in the model description."""
    kind: str
    """Kind, one of `_core.VARIABLE_KINDS`."""
    description: str
    """Description for the user."""
    unit: str = ""
    """SI unit; empty for a dimensionless number."""
    index: int = 0
    """Index of the port, the field of the operating point, the node or the part; of a mesh: its
    number and that of the quantity times the number of meshes."""
    causality: Literal["independent", "input", "output", "parameter"] = "output"
    """Causality, as FMI defines it."""
    variability: Literal["continuous", "tunable", "fixed"] = "continuous"
    """Variability, as FMI defines it."""
    start: float | None = None
    """Start value of an input or a parameter."""
    minimum: float = 0.0
    """Smallest value of an input or a parameter."""
    maximum: float = 0.0
    """Largest value of an input or a parameter."""


SPEEDS = 33  # number of speeds at which the stability of the speed loop is checked
PORTS = {"input": MOTOR, "output": LOAD_MACHINE}
SHOWN = {
    "angle": ("angle of the {} shaft, which counts whole turns", "rad"),
    "speed": ("speed of the {} shaft", "rad/s"),
    "torque": ("torque on the {} shaft, positive if it acts counter-clockwise", "N m"),
}
LOSS = "tooth friction, mean of the last step, bearings and churning at its end"
DAMAGE = "Miner sum since the start, of gears the mean over their teeth; failure is expected at 1"
GIVEN = {"torque": "torque", "motion": "speed"}
"""Input variable of a port by its causality."""


def variables(scene: Scene, exported: Exported) -> list[Variable]:
    """List the variables of a scene.

    Args:
        scene: the scene.
        exported: records of the scene, for start values and ranges.

    Returns:
        The variables in the order of their value references.
    """
    return [
        Variable("time", "time", "time", "s", causality="independent"),
        *_of_ports(scene, exported),
        *_of_meshes(scene),
        Variable("power_loss", "power_loss", LOSS, "W"),
        *_of_temperatures(scene),
        *_of_damage(scene),
        *_of_point(scene),
    ]


def _of_ports(scene: Scene, exported: Exported) -> Iterator[Variable]:
    operation, ranges = exported.model.operation, exported.ranges
    starts = {"torque": operation.torque, "speed": operation.speed}
    limits = {"torque": ranges.torque, "speed": ranges.speed}
    for side, place in PORTS.items():
        port: Causality = getattr(scene.drive.ports, side)
        for kind, (text, unit) in SHOWN.items():
            name, description = f"{side}.{kind}", text.format(side)
            if kind != GIVEN.get(port):
                yield Variable(name, kind, description, unit, place)
                continue
            limit = float(limits[kind][place])
            yield Variable(
                name, kind, description, unit, place, "input",
                start=float(starts[kind][place]), minimum=-limit, maximum=limit,
            )  # fmt: skip


def _of_meshes(scene: Scene) -> Iterator[Variable]:
    meshes = Gearbox(scene).mesh_names.names
    for place, mesh in enumerate(meshes):
        for row, (name, quantity) in enumerate(WAVEFORM.items()):
            yield Variable(
                f"{mesh}.{name}", "mesh", f"{mesh}: {quantity.text}", quantity.si,
                row * len(meshes) + place,
            )  # fmt: skip


def _of_temperatures(scene: Scene) -> Iterator[Variable]:
    if scene.thermal is None:
        return
    for place, node in enumerate(NODES):
        text = f"temperature of the {node}"
        yield Variable(f"temperature.{node}", "temperature", text, "K", place)


def _of_damage(scene: Scene) -> Iterator[Variable]:
    for place, part in enumerate(part_names(scene)):
        yield Variable(f"damage.{part}", "damage", f"{DAMAGE}: {part}", index=place)


def _of_point(scene: Scene) -> Iterator[Variable]:
    """Fields of the operating point that can change without the scene."""
    for name, variability in _variabilities(scene).items():
        tunable = scene.tunables[name]
        yield Variable(
            f"operating_point.{name}", "point", tunable.description, tunable.unit,
            POINT_FIELDS.index(name), "parameter", variability,
            float(getattr(scene.operating_point, name)), tunable.minimum, tunable.maximum,
        )  # fmt: skip


def _variabilities(scene: Scene) -> dict[str, Literal["tunable", "fixed"]]:
    """Fields that can be set: at any time (tunable), or until the start of a run (fixed).

    All others keep the values of the scene: fields without effect, fields whose bounds depend on
    other parts of the scene, and the speed if the speed loop is not stable at every speed.
    """
    ports = scene.drive.ports
    variabilities: dict[str, Literal["tunable", "fixed"]] = {}
    if scene.thermal is not None:
        variabilities["ambient_temperature"] = "tunable"
    if scene.lubrication.lambda_ratio == "prescribed":
        variabilities["lambda_ratio"] = "tunable"
    if _holds_any_speed(scene):
        variabilities["input_speed"] = "tunable" if ports.hold_speed else "fixed"
    if _accepts_any_load(scene):
        variabilities["backlash"] = "tunable"
        variabilities["input_torque"] = "tunable" if "machine" in ports else "fixed"
        if ports.input == "machine":
            variabilities["torque_ripple"] = "tunable"
    return {
        name: variabilities[name] for name in OperatingPoint.model_fields if name in variabilities
    }


def _accepts_any_load(scene: Scene) -> bool:
    """Whether the bounds of backlash and torques are independent of the rest of the scene.

    Bounds of runout and tip relief depend on them; they are strictest without load and backlash.
    """
    lightest_load = {"backlash": scene.tunables["backlash"].minimum, "input_torque": 0.0}
    try:
        scene.point_with(scene.operating_point, lightest_load)
    except ValueError:
        return False
    return True


def _holds_any_speed(scene: Scene) -> bool:
    """Whether the speed loop is stable at every speed that the drive allows.

    Speed-dependent mesh damping is lowest at the highest speed, where the loop is least stable;
    lower speeds are checked, too.
    """
    loop = SpeedLoopCheck(Gearbox(scene))
    try:
        for speed in np.linspace(0.0, scene.drive.speed_limit, SPEEDS):
            loop.check(scene.operating_point.model_copy(update={"input_speed": float(speed)}))
    except ValueError:
        return False
    return True
