"""The parameters of the follower."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import planetary_twin_py as pt
from planetary_twin_py.following.channels.all import CHANNELS
from planetary_twin_py.following.checks.checked_bins import PERIOD
from planetary_twin_py.following.sensors import JointNames, read_sensors

from ..base.damage import path_of
from ..base.parameter_node import ParameterNode
from ..base.parameters import (
    AT_ONCE,
    declare,
    declare_settings,
    read_named,
    setting,
    settings_of,
)

_LARGEST = 1e6  # factor on readings


@dataclass(frozen=True)
class FollowerSettings:
    """Parameters; all but `baseline` and the limits may change until the node is configured."""

    scene: str = setting("paper", "packaged scene, or path of a YAML file")
    sensors: str = setting("", "YAML file with the accuracy of the sensors; empty: class 0.1")
    input_joint: str = setting("", "joint of the input; empty: as `sensors` states")
    output_joint: str = setting("", "joint of the output; empty: as `sensors` states")
    period: float = setting(PERIOD, "time over which readings are averaged [s]", (0.01, 60.0))
    publish_rate: float = setting(
        10.0, "largest rate of estimate and residuals [Hz]", (0.1, 100.0)
    )
    sensor_timeout: float = setting(
        2.0, "silence after which estimates are stale [s]", (0.1, 3600.0)
    )
    reset_on_time_jump: bool = setting(
        False, "restart when stamps jump back, as those of a bag in a loop"
    )
    frame_id: str = setting("gearbox", "base frame of the gearbox")
    hardware_id: str = setting(
        "", "serial number of the gearbox; empty: the namespace of the node"
    )
    twin: str = setting("", "simulation whose operating point follows the estimates; empty: none")
    baseline: str = setting("", "file of the services save_baseline and load_baseline", when="")
    damage_file: str = setting(
        "",
        "JSON file with the damage of the gearbox, which the readings continue; written each "
        "minute and at the end. The scene needs its section durability; empty: no damage",
    )
    friction_limit: float = setting(
        2.0, "friction level above which /diagnostics reports an error [-]", (1.0, 100.0), AT_ONCE
    )
    tooth_limit: float = setting(
        0.05,
        "loss of stiffness of a tooth above which /diagnostics reports an error [-]",
        (0.0, 1.0),
        AT_ONCE,
    )


@dataclass(frozen=True)
class Followed:
    """The gearbox and its sensors; `scale` are factors on the readings of a channel."""

    scene: pt.Scene
    sensors: pt.Sensors
    joints: JointNames
    scale: dict[str, float]
    period: float  # [s]
    damage_file: Path | None

    def follower(self) -> pt.Follower:
        """Return a new follower."""
        return pt.Follower(
            self.scene, self.sensors, None, self.scale, self.period, self.damage_file
        )


def declare_parameters(node: ParameterNode) -> None:
    """Declare the parameters on `node`; raises `ValueError` if a start value is out of range."""
    declare_settings(node, FollowerSettings)
    for name in CHANNELS:
        declare(
            node,
            f"scale.{name}",
            1.0,
            f"factor on readings of {name}, for other units and signs; 1: as `sensors` states [-]",
            (-_LARGEST, _LARGEST),
        )


def followed(node: ParameterNode) -> Followed:
    """
    Return the gearbox and the sensors that the parameters of `node` name.

    Raises `ValueError` or `OSError` for an invalid scene or file of sensors.
    """
    given = settings_of(node, FollowerSettings)
    sensors = pt.Sensors()
    if given.sensors:
        sensors = read_named("sensors", given.sensors, read_sensors)
    joints = {"input": given.input_joint, "output": given.output_joint}
    scale = {name: node.get_parameter(f"scale.{name}").value for name in CHANNELS}
    return Followed(
        pt.load_scene(given.scene),
        sensors,
        sensors.joints.model_copy(update={side: name for side, name in joints.items() if name}),
        sensors.scale | {name: factor for name, factor in scale.items() if factor != 1.0},
        given.period,
        path_of(given.damage_file),
    )
