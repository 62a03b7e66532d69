"""Finds topics to record in the ROS graph: names, types, and a QoS that matches all publishers."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module

from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from rclpy.topic_endpoint_info import TopicEndpointInfo

from planetary_twin_py.following.channels.message_types import JOINTS, TEMPERATURE
from planetary_twin_py.following.channels.sampled import DEVICES
from planetary_twin_py.recording.ros2.metadata import Topic
from planetary_twin_py.recording.ros2.schema import message_definition
from planetary_twin_py.recording.ros2.sensor_topics import LEVELS, SENSORS

from .qos import to_words

UNKNOWN_NODE = "_NODE_NAME_UNKNOWN_"
"""Name in rmw for the node of an endpoint until discovery finds it, which may never happen."""
MEASURED = {
    "measured/joint_states": JOINTS[0],
    "measured/dynamic_joint_states": JOINTS[1],
    "measured/oil_temperature": TEMPERATURE,
    **{f"measured/{name}": device.message for name, device in DEVICES.items()},
}
"""Types of the topics of a measured gearbox, by name."""
_EVERYWHERE = ("/diagnostics", "/tf")
# Below the namespace: a measured gearbox, its follower, and sensors with their levels.
_BELOW = ("measured", "follower", SENSORS)
_OF_ROS = ("/rosout", "/parameter_events")


def wanted_topics(node: Node, chosen: Sequence[str]) -> list[str]:
    """
    Return the names of existing topics to record.

    These are the topics in `chosen`; if it is empty, those directly in the namespace of `node` and
    in `measured`, `follower` and `sensors` below it, those to which the topics of a measured
    gearbox are remapped, /diagnostics and /tf.
    """
    names = {name for name, _ in node.get_topic_names_and_types()}
    if chosen:
        return sorted(names & {node.resolve_topic_name(name) for name in chosen})
    measured = [node.resolve_topic_name(name) for name in MEASURED]
    own = [name for name in names if is_of_twin(name, node.get_namespace())]
    # A subscription to a name that is remapped is one to the other name.
    return sorted(names & {*measured, *map(node.resolve_topic_name, own)})


def is_of_twin(name: str, namespace: str) -> bool:
    """Return whether a logger in `namespace` records the topic `name` by default."""
    if name in _OF_ROS or name.endswith("/transition_event"):
        return False
    own = namespace.rstrip("/")
    places = {own, *(f"{own}/{below}" for below in _BELOW)}
    above = name.removesuffix(f"/{LEVELS}").rpartition("/")[0]
    return name in _EVERYWHERE or above in places


def describe(name: str, publishers: Sequence[TopicEndpointInfo]) -> Topic:
    """Return the description of the topic `name` for a bag."""
    first = publishers[0]
    return Topic(
        name=name,
        type=first.topic_type,
        type_hash=str(first.topic_type_hash),
        definition=message_definition(first.topic_type),
        offered_qos=[to_words(publisher.qos_profile) for publisher in publishers],
    )


def message_class(type_name: str) -> type:
    """Return the class of the message `pkg/msg/Name`; raises `ImportError` if there is none."""
    package, kind, name = type_name.split("/")
    try:
        return getattr(import_module(f"{package}.{kind}"), name)
    except AttributeError as missing:
        raise ImportError(f"{type_name}: no such message") from missing


def matching_qos(publishers: Sequence[TopicEndpointInfo]) -> QoSProfile:
    """
    Return the strictest profile that is compatible with every one of `publishers`.

    Its history is KEEP_ALL, so that a slow disk never causes received messages to be overwritten.
    If the queue of Fast DDS is full (5000 messages), a reliable publisher sends the message again.
    """
    offered = [publisher.qos_profile for publisher in publishers]
    reliable = all(qos.reliability == ReliabilityPolicy.RELIABLE for qos in offered)
    latched = all(qos.durability == DurabilityPolicy.TRANSIENT_LOCAL for qos in offered)
    return QoSProfile(
        history=HistoryPolicy.KEEP_ALL,
        reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
    )
