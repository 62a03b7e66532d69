"""Starts a twin: the simulation, and the logger unless `record` is false."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, Shutdown
from launch.conditions import IfCondition
from launch.substitution import Substitution
from launch.substitutions import (
    AndSubstitution,
    EnvironmentVariable,
    IfElseSubstitution,
    LaunchConfiguration,
    NotSubstitution,
    PathJoinSubstitution,
)
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare

_CONFIG = PathJoinSubstitution([FindPackageShare("planetary_twin"), "config", "twin.yaml"])
_DOMAIN = EnvironmentVariable("ROS_DOMAIN_ID", default_value="0")
# A deprecated name precedes the name that replaces it and takes its value as the default.
_ARGUMENTS = (
    ("scene", "paper", "packaged scene, or path of a YAML file"),
    ("namespace", "planetary_twin", "namespace of the nodes, one for each twin"),
    ("frame_prefix", "", "prefix of all frame names in /tf, one for each twin"),
    ("record", "true", "record with the logger, into recordings/ of the working directory"),
    ("respawn", "false", "start a logger that has died again; it makes another recording"),
    ("rate_factor", "1.0", "simulated seconds per second"),
    ("params", _CONFIG, "deprecated name of params_file"),
    ("params_file", LaunchConfiguration("params"), "YAML file with parameters of both nodes"),
    ("use_sim_time", "false", "stamp with the time on /clock, which another node publishes"),
    ("log_level", "info", "log level of both nodes: debug, info, warn, error or fatal"),
    ("domain", _DOMAIN, "ROS_DOMAIN_ID of the nodes: twins in different domains are isolated"),
    ("composed", "false", "deprecated name of use_composition"),
    (
        "use_composition",
        LaunchConfiguration("composed"),
        "run simulation and logger in one process, for up to some 100 messages/s",
    ),
)

_RESPAWN_DELAY = 1.0  # [s]
_RECORDED_BY = IfElseSubstitution(LaunchConfiguration("record"), "logger", "")


def generate_launch_description() -> LaunchDescription:
    """Return the arguments and nodes; the launch ends with the simulation."""
    arguments = [
        DeclareLaunchArgument(name, default_value=default, description=description)
        for name, default, description in _ARGUMENTS
    ]
    record = LaunchConfiguration("record")
    both = AndSubstitution(record, LaunchConfiguration("use_composition"))
    apart = NotSubstitution(both)
    nodes = [
        _node(
            "logger",
            AndSubstitution(record, apart),
            respawn=LaunchConfiguration("respawn"),
            respawn_delay=_RESPAWN_DELAY,
        ),
        _node("simulation", apart, on_exit=Shutdown()),
        _node("twin", both, on_exit=Shutdown()),
    ]
    return LaunchDescription([*arguments, *nodes])


def _node(executable: str, condition: Substitution, **options: object) -> Node:
    given = {
        "scene": ParameterValue(LaunchConfiguration("scene"), value_type=str),
        "use_sim_time": ParameterValue(LaunchConfiguration("use_sim_time"), value_type=bool),
    }
    if executable != "logger":
        given |= {
            "rate_factor": ParameterValue(LaunchConfiguration("rate_factor"), value_type=float),
            "wait_for": ParameterValue(_RECORDED_BY, value_type=str),
            "frame_prefix": ParameterValue(LaunchConfiguration("frame_prefix"), value_type=str),
        }
    return Node(
        package="planetary_twin",
        executable=executable,
        namespace=LaunchConfiguration("namespace"),
        output="screen",
        additional_env={"ROS_DOMAIN_ID": LaunchConfiguration("domain")},
        parameters=[LaunchConfiguration("params_file"), given],
        ros_arguments=["--log-level", LaunchConfiguration("log_level")],
        condition=IfCondition(condition),
        **options,
    )
