"""The topics of a twin as its nodes publish them, without ROS."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from .metadata import Topic
from .schema import installed_definition, message_definition
from .sensor_topics import sensor_topics
from .topics import (
    AXES_STATE,
    AXES_WAVEFORM,
    DAMAGE,
    DAMAGE_TEETH,
    DESCRIPTION,
    GIVEN,
    JOINTS,
    ORIGIN,
    POINT,
    STATE,
    WAVEFORM,
)

EVERY = {
    ORIGIN: "std_msgs/msg/String",
    DESCRIPTION: "std_msgs/msg/String",
    POINT: "planetary_twin_msgs/msg/OperatingPoint",
    STATE: "planetary_twin_msgs/msg/GearboxState",
    JOINTS: "sensor_msgs/msg/JointState",
    WAVEFORM: "planetary_twin_msgs/msg/MeshWaveform",
}
OF_AXES = {
    AXES_STATE: "planetary_twin_msgs/msg/AxesState",
    AXES_WAVEFORM: "planetary_twin_msgs/msg/AxesWaveform",
}
OF_DAMAGE = {
    DAMAGE: "planetary_twin_msgs/msg/DamageState",
    DAMAGE_TEETH: "planetary_twin_msgs/msg/DamageTeeth",
}
OF_PORTS = {GIVEN: "sensor_msgs/msg/JointState"}
KINDS = EVERY | OF_AXES | OF_DAMAGE
_LATCHED = (ORIGIN, DESCRIPTION, POINT, DAMAGE)
_NEVER = {"sec": 9_223_372_036, "nsec": 854_775_807}


def kinds_beside(
    moving_axes: bool,
    driven: bool,
    sensors: Mapping[str, str] = MappingProxyType({}),
    ages: bool = False,
) -> dict[str, str]:
    """Types of the topics that only some twins have, by name; for the arguments see `topics_of`."""
    kinds = (OF_AXES if moving_axes else {}) | (OF_PORTS if driven else {})
    kinds |= OF_DAMAGE if ages else {}
    return kinds | sensor_topics(sensors)


def topics_of(
    namespace: str,
    moving_axes: bool = False,
    driven: bool = False,
    sensors: Mapping[str, str] = MappingProxyType({}),
    ages: bool = False,
) -> list[Topic]:
    """Topics of a twin in `namespace` whose messages follow from its windows.

    Args:
        namespace: namespace of the twin.
        moving_axes: whether its axes move.
        driven: whether torques or motions are given at its ports.
        sensors: kind of each of its sensors by name.
        ages: whether its scene has the section `durability`.
    """
    kinds = EVERY | kinds_beside(moving_axes, driven, sensors, ages)
    return [
        topic_of(f"{namespace}/{name}", kind, latched=name in _LATCHED)
        for name, kind in kinds.items()
    ]


def topic_of(name: str, kind: str, *, latched: bool = False) -> Topic:
    """A topic with the QoS of the nodes.

    Args:
        name: of the topic.
        kind: its type.
        latched: whether late subscribers receive the last message.
    """
    types = get_typestore(Stores.ROS2_JAZZY)
    definition = definition_of(kind)
    parsed = get_types_from_msg(definition, kind)
    types.register({name: fields for name, fields in parsed.items() if name not in types.types})
    return Topic(name, kind, types.hash_rihs01(kind), definition, [_offer(latched)])


def definition_of(kind: str) -> str:
    """Definition of a type of the twin's topics in MCAP's encoding `ros2msg`."""
    return message_definition(kind, _text)


def _text(kind: str) -> str:
    """Text of one .msg file, from this package or from rosbags."""
    package, _, name = kind.split("/")
    if package == "planetary_twin_msgs":
        file = Path(__file__).parent / "msg" / f"{name}.msg"
        # If installed as a ROS package, the files belong to planetary_twin_msgs.
        return file.read_text(encoding="utf-8") if file.is_file() else installed_definition(kind)
    text, _ = get_typestore(Stores.ROS2_JAZZY).generate_msgdef(kind, ros_version=2)
    return text.partition("=" * 80)[0]


def _offer(latched: bool) -> dict[str, Any]:
    """Quality of service of the nodes, in the format of rosbag2."""
    return {
        "history": "keep_last",
        "depth": 1 if latched else 10,
        "reliability": "reliable",
        "durability": "transient_local" if latched else "volatile",
        "deadline": _NEVER,
        "lifespan": _NEVER,
        "liveliness": "automatic",
        "liveliness_lease_duration": _NEVER,
        "avoid_ros_namespace_conventions": False,
    }
