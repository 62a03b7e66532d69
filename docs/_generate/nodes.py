"""Topics, services and parameters of the nodes, read from the nodes themselves."""

import os
from collections.abc import Iterator
from tempfile import TemporaryDirectory
from textwrap import fill

# The nodes exist in this process only; no other process should discover them.
os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "OFF"

import rclpy
from planetary_twin.base.parameters import changes
from planetary_twin.follower.node import Follower
from planetary_twin.logger.node import Logger
from planetary_twin.plant.node import Plant
from planetary_twin.replay.node import Replay
from planetary_twin.simulation.node import Simulation
from rcl_interfaces.msg import ParameterDescriptor, ParameterType
from rclpy.lifecycle import TransitionCallbackReturn
from rclpy.node import Node
from rclpy.parameter import Parameter

_NODES = {
    "simulation": Simulation,
    "logger": Logger,
    "replay": Replay,
    "follower": Follower,
    "plant": Plant,
}
_TYPES = {
    value: name.removeprefix("PARAMETER_").lower().replace("_", " ")
    for name, value in vars(ParameterType).items()
    if name.startswith("PARAMETER_")
}
_OF_ROS = {"use_sim_time", "start_type_description_service"}
_OF_SCENE = "| `{0}.*` | as in the scene | with scene | [its fields](scene-fields.md#{0}) |\n"
_TITLES = "parameter", "type = default; range", "changes", "meaning"
_HEAD = """# Parameters of the nodes

Generated from the nodes, with the scene `paper`. [Topics and services](topics-and-services.md)
explains what they publish and serve. Names are relative to the namespace `/planetary_twin` unless
they start with a slash.

| parameters change | when |
|---|---|
| live | at any time |
| unconfigured | until the node is configured, and after it is cleaned up |
| with scene | they show the scene; choose another scene to set them |
| at start | with `-p NAME:=VALUE` only |
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
        rest = _names("Serves", _services(node)) + _parameters(node)  # before topics change them
        return f"\n## Node `{name}`\n{_names('Publishes', _topics(node))}{rest}"
    finally:
        node.destroy_node()


def _names(verb: str, names: Iterator[str]) -> str:
    listed = ", ".join(f"`{name}`" for name in sorted(names))
    return f"\n{fill(f'{verb} {listed}.', 100, break_on_hyphens=False)}\n" if listed else ""


def _topics(node: Node) -> Iterator[str]:
    """Topics of a configured node; those of a replay depend on its recording."""
    if isinstance(node, Replay):
        return
    with TemporaryDirectory() as folder:
        if isinstance(node, Logger):
            node.set_parameters([Parameter("directory", value=folder)])
        assert node.trigger_configure() == TransitionCallbackReturn.SUCCESS
        for publisher in node.publishers:
            name = publisher.topic_name
            if not name.endswith(("/transition_event", "rosout", "parameter_events")):
                yield _short(name)
        node.close()


def _services(node: Node) -> Iterator[str]:
    for service in node.services:
        package = service.srv_type.__module__.split(".")[0]
        if package not in ("rcl_interfaces", "lifecycle_msgs", "type_description_interfaces"):
            yield _short(service.service_name)


def _short(name: str) -> str:
    return name.removeprefix("/planetary_twin/")


def _parameters(node: Node) -> str:
    lines = [f"\n| {' | '.join(_TITLES)} |\n", "|---" * len(_TITLES), "|\n"]
    for name, parameter in sorted(node.get_parameters_by_prefix("").items()):
        if name.startswith("qos_overrides") or name in _OF_ROS:
            continue
        descriptor = node.describe_parameter(name)
        section = name.split(".")[0]
        if changes(descriptor) != "with scene":
            lines.append(_parameter(descriptor, parameter.value))
        elif (row := _OF_SCENE.format(section)) not in lines:
            lines.append(row)
    return "".join(lines)


def _parameter(descriptor: ParameterDescriptor, value: object) -> str:
    limits = descriptor.floating_point_range
    span = f"; {limits[0].from_value:g} to {limits[0].to_value:g}" if limits else ""
    shown = f"{value:g}" if isinstance(value, float) else f"`{value!r}`"
    cells = (
        f"`{descriptor.name}`",
        f"{_TYPES[descriptor.type]} = {shown}{span}",
        changes(descriptor),
        descriptor.description,
    )
    return "| " + " | ".join(cells) + " |\n"
