"""Starts a follower of a measured gearbox, and the logger unless `record` is false."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, Shutdown
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue

_ARGUMENTS = (
    ("scene", "paper", "packaged scene, or path of a YAML file"),
    ("sensors", "", "YAML file with the accuracy of the sensors"),
    ("namespace", "planetary_twin", "namespace of the nodes, one for each gearbox"),
    ("joint_states", "measured/joint_states", "topic of the measured joint states"),
    ("oil_temperature", "measured/oil_temperature", "topic of the measured oil temperature"),
    ("encoders", "measured/encoders", "topic of the blocks of encoder samples"),
    ("record", "true", "record with the logger, into recordings/ of the working directory"),
    ("use_sim_time", "false", "take the time from /clock, which another node publishes"),
    ("log_level", "info", "log level of both nodes: debug, info, warn, error or fatal"),
)
_REMAPPED = "joint_states", "oil_temperature", "encoders"


def generate_launch_description() -> LaunchDescription:
    """Return the arguments and nodes; the launch ends with the follower."""
    arguments = [
        DeclareLaunchArgument(name, default_value=default, description=description)
        for name, default, description in _ARGUMENTS
    ]
    follower = _node(
        "follower",
        {"sensors": ParameterValue(LaunchConfiguration("sensors"), value_type=str)},
        remappings=[(f"measured/{name}", LaunchConfiguration(name)) for name in _REMAPPED],
        on_exit=Shutdown(),
    )
    logger = _node("logger", {}, condition=IfCondition(LaunchConfiguration("record")))
    return LaunchDescription([*arguments, logger, follower])


def _node(executable: str, given: dict[str, ParameterValue], **options: object) -> Node:
    shared = {
        "scene": ParameterValue(LaunchConfiguration("scene"), value_type=str),
        "use_sim_time": ParameterValue(LaunchConfiguration("use_sim_time"), value_type=bool),
    }
    return Node(
        package="planetary_twin",
        executable=executable,
        namespace=LaunchConfiguration("namespace"),
        output="screen",
        parameters=[shared | given],
        ros_arguments=["--log-level", LaunchConfiguration("log_level")],
        **options,
    )
