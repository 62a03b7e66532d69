"""Starts a twin: the simulation, and the logger unless told not to."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare

_CONFIG = PathJoinSubstitution([FindPackageShare("planetary_twin"), "config", "paper.yaml"])
_ARGUMENTS = (
    ("scene", "paper", "packaged scene, or path of a YAML file"),
    ("namespace", "planetary_twin", "one per twin, so that several run side by side"),
    ("record", "true", "whether the logger records"),
    ("rate_factor", "1.0", "simulated seconds per second"),
    ("params", _CONFIG, "YAML file with parameters of both nodes"),
)


def generate_launch_description() -> LaunchDescription:
    """Arguments and nodes."""
    arguments = [
        DeclareLaunchArgument(name, default_value=default, description=description)
        for name, default, description in _ARGUMENTS
    ]
    given = {name: LaunchConfiguration(name) for name, _, _ in _ARGUMENTS}
    simulation = Node(
        package="planetary_twin",
        executable="simulation",
        namespace=given["namespace"],
        output="screen",
        parameters=[
            given["params"],
            {
                "scene": ParameterValue(given["scene"], value_type=str),
                "rate_factor": ParameterValue(given["rate_factor"], value_type=float),
            },
        ],
    )
    logger = Node(
        package="planetary_twin",
        executable="logger",
        namespace=given["namespace"],
        output="screen",
        parameters=[
            given["params"],
            {"scene": ParameterValue(given["scene"], value_type=str)},
        ],
        condition=IfCondition(given["record"]),
    )
    return LaunchDescription([*arguments, logger, simulation])
