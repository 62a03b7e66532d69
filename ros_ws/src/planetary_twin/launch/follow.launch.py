"""Starts a follower of a measured gearbox, and the logger unless `record` is false."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, Shutdown
from launch.conditions import IfCondition
from launch.substitution import Substitution
from launch.substitutions import (
    AndSubstitution,
    LaunchConfiguration,
    NotSubstitution,
    PathJoinSubstitution,
)
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare

from planetary_twin_py.following.channels.sampled import DEVICES

_CONFIG = PathJoinSubstitution([FindPackageShare("planetary_twin"), "config", "twin.yaml"])
_MEASURED = {
    "joint_states": "joint states",
    "dynamic_joint_states": "dynamic joint states",
    "oil_temperature": "oil temperature",
    **{name: f"samples of {device.sensors}" for name, device in DEVICES.items()},
}
_ARGUMENTS = (
    ("scene", "paper", "packaged scene, or path of a YAML file"),
    ("sensors", "", "YAML file with the accuracy of the sensors"),
    ("namespace", "planetary_twin", "namespace of the nodes, one for each gearbox"),
    *((name, f"measured/{name}", f"topic of the measured {what}")
      for name, what in _MEASURED.items()),
    ("record", "true", "record with the logger, into recordings/ of the working directory"),
    ("params_file", _CONFIG, "YAML file with parameters of both nodes"),
    ("use_sim_time", "false", "take the time from /clock, which another node publishes"),
    ("log_level", "info", "log level of both nodes: debug, info, warn, error or fatal"),
    ("use_composition", "false", "run follower and logger in one process"),
)  # fmt: skip


def generate_launch_description() -> LaunchDescription:
    """Return the arguments and nodes; the launch ends with the follower."""
    arguments = [
        DeclareLaunchArgument(name, default_value=default, description=description)
        for name, default, description in _ARGUMENTS
    ]
    record = LaunchConfiguration("record")
    both = AndSubstitution(record, LaunchConfiguration("use_composition"))
    apart = NotSubstitution(both)
    nodes = [
        _node("logger", AndSubstitution(record, apart)),
        _node("follower", apart, on_exit=Shutdown()),
        _node("recorded_follower", both, on_exit=Shutdown()),
    ]
    return LaunchDescription([*arguments, *nodes])


def _node(executable: str, condition: Substitution, **options: Shutdown) -> Node:
    given = {
        "scene": ParameterValue(LaunchConfiguration("scene"), value_type=str),
        "use_sim_time": ParameterValue(LaunchConfiguration("use_sim_time"), value_type=bool),
    }
    if executable != "logger":
        given["sensors"] = ParameterValue(LaunchConfiguration("sensors"), value_type=str)
    return Node(
        package="planetary_twin",
        executable=executable,
        namespace=LaunchConfiguration("namespace"),
        output="screen",
        parameters=[LaunchConfiguration("params_file"), given],
        remappings=[(f"measured/{name}", LaunchConfiguration(name)) for name in _MEASURED],
        ros_arguments=["--log-level", LaunchConfiguration("log_level")],
        condition=IfCondition(condition),
        **options,
    )
