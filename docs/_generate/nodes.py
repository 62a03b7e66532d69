"""What the nodes publish, serve and can be set to, asked of the nodes themselves."""

import os
from collections.abc import Iterator

# The nodes are asked in this process: nobody else is to hear of them.
os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "OFF"

import rclpy
from planetary_twin.logger import Logger
from planetary_twin.replay import Replay
from planetary_twin.simulation import Simulation
from rcl_interfaces.msg import ParameterDescriptor, ParameterType
from rclpy.node import Node

_NODES = {"simulation": Simulation, "logger": Logger, "replay": Replay}
_TYPES = {
    value: name.removeprefix("PARAMETER_").lower().replace("_", " ")
    for name, value in vars(ParameterType).items()
    if name.startswith("PARAMETER_")
}
_OF_ROS = {"use_sim_time", "start_type_description_service"}
_TITLES = "parameter", "type", "default", "range", "changes", "meaning"
_HEAD = """# Nodes

Made from the nodes, with the scene `paper`. Names are below the namespace `/planetary_twin` unless
they begin with a slash. What topics and services are for, and how they act together, is told in
[topics and services](topics-and-services.md). The parameter and life
cycle services that every node has are left out.
"""


def page() -> str:
    """A section for every node."""
    rclpy.init(args=["--ros-args", "--log-level", "warn", "-r", "__ns:=/planetary_twin"])
    try:
        return _HEAD + "".join(_section(name, node) for name, node in _NODES.items())
    finally:
        rclpy.try_shutdown()


def _section(name: str, kind: type[Node]) -> str:
    node = kind()
    try:
        return (
            f"\n## Node `{name}`\n"
            + _table("topic", "type", _topics(node))
            + _table("service", "type", _services(node))
            + _parameters(node)
        )
    finally:
        node.destroy_node()


def _table(title: str, second: str, rows: Iterator[tuple[str, str]]) -> str:
    lines = [f"| `{name}` | {kind} |\n" for name, kind in sorted(rows)]
    return f"\n| {title} | {second} |\n|---|---|\n" + "".join(lines) if lines else ""


def _topics(node: Node) -> Iterator[tuple[str, str]]:
    for publisher in node.publishers:
        if not publisher.topic_name.endswith(("/transition_event", "rosout", "parameter_events")):
            yield _short(publisher.topic_name), _type(publisher.msg_type)


def _services(node: Node) -> Iterator[tuple[str, str]]:
    for service in node.services:
        kind = _type(service.srv_type)
        if not kind.startswith(("rcl_interfaces/", "lifecycle_msgs/", "type_description_")):
            yield _short(service.service_name), kind


def _short(name: str) -> str:
    return name.removeprefix("/planetary_twin/")


def _type(kind: type) -> str:
    return f"{kind.__module__.split('.')[0]}/{kind.__name__}"


def _parameters(node: Node) -> str:
    lines = [f"\n| {' | '.join(_TITLES)} |\n", "|---" * len(_TITLES), "|\n"]
    for name, parameter in sorted(node.get_parameters_by_prefix("").items()):
        if not name.startswith(("qos_overrides", "gearset.")) and name not in _OF_ROS:
            lines.append(_parameter(node.describe_parameter(name), parameter.value))
    return "".join(lines)


def _parameter(told: ParameterDescriptor, value: object) -> str:
    limits = told.floating_point_range
    span = f"{limits[0].from_value:g} to {limits[0].to_value:g}" if limits else ""
    cells = (
        f"`{told.name}`",
        _TYPES[told.type],
        f"{value:g}" if isinstance(value, float) else f"`{value!r}`",
        span,
        "at start" if told.read_only else "live",
        told.description,
    )
    return "| " + " | ".join(cells) + " |\n"
