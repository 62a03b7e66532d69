"""Metadata of a bag for rosbag2: `metadata.yaml`, version 9, and its copy in the MCAP file."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any, NamedTuple

import yaml

from ...scene.yaml_text import read_yaml
from ..container.extent import Extent

VERSION = 9
_TRANSIENT_LOCAL = ("transient_local", 1)  # the number in bags before version 9


@dataclass(frozen=True)
class Topic:
    """A topic of a bag.

    `type_hash` is the RIHS01 text, `offered_qos` one mapping per publisher in the format of
    rosbag2, `definition` the `ros2msg` schema text.
    """

    name: str
    type: str
    type_hash: str
    definition: str
    offered_qos: Sequence[Mapping[str, Any]] = field(default_factory=list)

    @property
    def qos_yaml(self) -> str:
        """The offered profiles as YAML, for the channel metadata of MCAP."""
        return yaml.safe_dump([dict(qos) for qos in self.offered_qos], sort_keys=False)

    @property
    def kept(self) -> int:
        """Number of messages that a late subscriber receives, see `kept_by`."""
        return kept_by(self.offered_qos)


@lru_cache(maxsize=1024)  # most topics of a bag have the same profiles
def read_offered_qos(text: str) -> Sequence[Mapping[str, Any]]:
    """The profiles in a text that `Topic.qos_yaml` or rosbag2 has written; none in other texts."""
    try:
        profiles = read_yaml(text, "offered_qos_profiles")
    except ValueError:
        return []
    listed = profiles if isinstance(profiles, list) else []
    return [qos for qos in listed if isinstance(qos, dict) and isinstance(qos.get("depth", 0), int)]


def kept_by(offered_qos: Sequence[Mapping[str, Any]]) -> int:
    """Number of messages that a late subscriber receives; 0 unless the topic is latched.

    Latched topics are transient local. A publisher of unknown depth is assumed to keep its newest
    message.
    """
    return sum(
        max(int(qos.get("depth", 0)), 1)
        for qos in offered_qos
        if qos.get("durability") in _TRANSIENT_LOCAL
    )


class FileEntry(NamedTuple):
    """A file of the bag: name, time interval and number of messages."""

    name: str
    extent: Extent
    messages: int


def bag_metadata(files: Sequence[FileEntry], topics: Sequence[tuple[Topic, int]]) -> dict[str, Any]:
    """Metadata of a bag from its files, and its topics with their message counts."""
    extent = Extent()
    for file in files:
        if file.messages:
            extent.include(file.extent.start)
            extent.include(file.extent.end)
    return {
        "version": VERSION,
        "storage_identifier": "mcap",
        **_span(extent, sum(file.messages for file in files)),
        "topics_with_message_count": [_topic_entry(topic, count) for topic, count in topics],
        "compression_format": "",
        "compression_mode": "",
        "relative_file_paths": [file.name for file in files],
        "files": [{"path": file.name, **_span(file.extent, file.messages)} for file in files],
        "custom_data": None,
        "ros_distro": os.environ.get("ROS_DISTRO", "jazzy"),
    }


def metadata_yaml(metadata: Mapping[str, Any]) -> str:
    """Text of `metadata.yaml`, which has the metadata below a top-level key."""
    return yaml.safe_dump({"rosbag2_bagfile_information": metadata}, sort_keys=False)


def metadata_record(metadata: Mapping[str, Any]) -> dict[str, str]:
    """Metadata record of an MCAP file, where rosbag2 looks first; without the top-level key."""
    return {"serialized_metadata": yaml.safe_dump(metadata, sort_keys=False)}


def _span(extent: Extent, messages: int) -> dict[str, Any]:
    return {
        "duration": {"nanoseconds": extent.end - extent.start},
        "starting_time": {"nanoseconds_since_epoch": extent.start},
        "message_count": messages,
    }


def _topic_entry(topic: Topic, count: int) -> dict[str, Any]:
    return {
        "topic_metadata": {
            "name": topic.name,
            "type": topic.type,
            "serialization_format": "cdr",
            "offered_qos_profiles": [dict(qos) for qos in topic.offered_qos],
            "type_description_hash": topic.type_hash,
        },
        "message_count": count,
    }
