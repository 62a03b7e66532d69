"""The parameters of the follower."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from rclpy.node import Node

import planetary_twin_py as pt
from planetary_twin_py.following.balance import PERIOD
from planetary_twin_py.following.channels.all import CHANNELS
from planetary_twin_py.following.sensors import JointNames, read_sensors

from ..base.parameter_node import ParameterNode
from ..base.parameters import AT_ONCE, declare

_LARGEST = 1e6  # factor on readings


@dataclass(frozen=True)
class FollowerOptions:
    """Scene, sensors and reporting of a follower."""

    scene: pt.Scene
    sensors: pt.Sensors
    joints: JointNames
    scale: dict[str, float]
    period: float  # [s]
    publish_rate: float  # [Hz]
    sensor_timeout: float  # [s]
    reset_on_time_jump: bool
    frame: str
    hardware: str
    twin: str

    def follower(self) -> pt.Follower:
        """Return a new follower."""
        return pt.Follower(self.scene, self.sensors, scale=self.scale, period=self.period)


def declare_options(node: ParameterNode) -> None:
    """
    Declare the parameters on `node`; all but the limits may change until it is configured.

    Raises `ValueError` if a value given at the start is out of its range.
    """
    declare(node, "scene", "paper", "packaged scene, or path of a YAML file")
    declare(node, "sensors", "", "YAML file with the accuracy of the sensors; empty: class 0.1")
    declare(node, "input_joint", "", "joint of the input; empty: as `sensors` states")
    declare(node, "output_joint", "", "joint of the output; empty: as `sensors` states")
    for name in CHANNELS:
        declare(
            node,
            f"scale.{name}",
            1.0,
            f"factor on readings of {name}, for other units and signs; 1: as `sensors` states [-]",
            (-_LARGEST, _LARGEST),
        )
    declare(node, "period", PERIOD, "time over which readings are averaged [s]", (0.01, 60.0))
    declare(
        node, "publish_rate", 10.0, "largest rate of estimate and residuals [Hz]", (0.1, 100.0)
    )
    declare(
        node, "sensor_timeout", 2.0, "silence after which estimates are stale [s]", (0.1, 3600.0)
    )
    declare(
        node,
        "reset_on_time_jump",
        False,
        "restart when stamps jump back, as those of a bag in a loop",
    )
    declare(node, "frame_id", "gearbox", "base frame of the gearbox")
    declare(
        node, "hardware_id", "", "serial number of the gearbox; empty: the namespace of the node"
    )
    declare(
        node, "twin", "", "simulation whose operating point follows the estimates; empty: none"
    )
    declare(node, "baseline", "", "file of the services save_baseline and load_baseline", when="")
    declare(
        node,
        "friction_limit",
        2.0,
        "friction level above which /diagnostics reports an error [-]",
        (1.0, 100.0),
        when=AT_ONCE,
    )
    declare(
        node,
        "tooth_limit",
        0.05,
        "loss of stiffness of a tooth above which /diagnostics reports an error [-]",
        (0.0, 1.0),
        when=AT_ONCE,
    )


def options_of(node: Node) -> FollowerOptions:
    """
    Return the values of the parameters of `node`.

    Raises `ValueError` or `OSError` for an invalid scene or file of sensors.
    """
    value = {
        name: parameter.value for name, parameter in node.get_parameters_by_prefix("").items()
    }
    sensors = pt.Sensors()
    if value["sensors"]:
        path = Path(value["sensors"]).expanduser()
        try:
            sensors = read_sensors(path)
        except OSError as reason:
            raise ValueError(f"sensors = {str(path)!r}: {reason.strerror}") from None
    given = {"input": value["input_joint"], "output": value["output_joint"]}
    scale = {name: value[f"scale.{name}"] for name in CHANNELS}
    return FollowerOptions(
        pt.load_scene(value["scene"]),
        sensors,
        sensors.joints.model_copy(update={k: name for k, name in given.items() if name}),
        sensors.scale | {name: factor for name, factor in scale.items() if factor != 1.0},
        value["period"],
        value["publish_rate"],
        value["sensor_timeout"],
        value["reset_on_time_jump"],
        value["frame_id"],
        value["hardware_id"] or node.get_namespace(),
        value["twin"],
    )
