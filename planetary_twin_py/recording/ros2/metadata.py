"""The description rosbag2 keeps of a bag: `metadata.yaml`, version 9, and MCAP's copy of it."""

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
_QOS = "offered_qos_profiles"
_TRANSIENT_LOCAL = ("transient_local", 1)  # the number in bags before version 9


@dataclass(frozen=True)
class Topic:
    """A topic as the bag describes it.

    `type_hash` is the RIHS01 text, `offered_qos` one mapping per publisher in rosbag2's words,
    `definition` the `ros2msg` schema text.
    """

    name: str
    type: str
    type_hash: str
    definition: str
    offered_qos: Sequence[Mapping[str, Any]] = field(default_factory=list)

    @property
    def qos_yaml(self) -> str:
        """The offered profiles as MCAP's channel metadata holds them."""
        return yaml.safe_dump([dict(qos) for qos in self.offered_qos], sort_keys=False)

    @property
    def kept(self) -> int:
        """How many messages a late subscriber still gets; 0 unless the topic is latched.

        A publisher whose depth the recorder could not learn is taken to keep its newest one.
        """
        return sum(
            max(int(qos.get("depth", 0)), 1)
            for qos in self.offered_qos
            if qos.get("durability") in _TRANSIENT_LOCAL
        )


def read_offered_qos(text: str) -> Sequence[Mapping[str, Any]]:
    """The profiles that `Topic.qos_yaml` has written, or rosbag2.

    Raises:
        ValueError: the text is something else.
    """
    found = _profiles(text)
    if isinstance(found, ValueError):
        raise found
    return found


@lru_cache(maxsize=1024)  # most topics of a bag offer the same; a refusal is kept, too
def _profiles(text: str) -> Sequence[Mapping[str, Any]] | ValueError:
    try:
        return _parsed(text)
    except ValueError as reason:
        return reason


def _parsed(text: str) -> Sequence[Mapping[str, Any]]:
    found = read_yaml(text, _QOS) or []
    if not isinstance(found, list) or not all(isinstance(qos, dict) for qos in found):
        raise ValueError(f"{_QOS}: must be a list of mappings")
    for qos in found:
        if not isinstance(qos.get("depth", 0), int):
            raise ValueError(f"{_QOS}: depth = {qos['depth']!r}: must be a whole number")
    return found


def is_latched(offered_qos: Sequence[Mapping[str, Any]]) -> bool:
    """Whether a publisher hands its newest messages to late subscribers."""
    return any(qos.get("durability") in _TRANSIENT_LOCAL for qos in offered_qos)


class FileEntry(NamedTuple):
    """A file of the bag: its name in the folder, and what it holds."""

    name: str
    extent: Extent
    messages: int


def bag_metadata(files: Sequence[FileEntry], topics: Sequence[tuple[Topic, int]]) -> dict[str, Any]:
    """What rosbag2 notes of a bag, from its topics' message counts."""
    whole = Extent()
    for file in files:
        if file.messages:
            whole.include(file.extent.start)
            whole.include(file.extent.end)
    return {
        "version": VERSION,
        "storage_identifier": "mcap",
        **_span(whole, sum(file.messages for file in files)),
        "topics_with_message_count": [_topic_entry(topic, count) for topic, count in topics],
        "compression_format": "",
        "compression_mode": "",
        "relative_file_paths": [file.name for file in files],
        "files": [{"path": file.name, **_span(file.extent, file.messages)} for file in files],
        "custom_data": None,
        "ros_distro": os.environ.get("ROS_DISTRO", "jazzy"),
    }


def metadata_yaml(metadata: Mapping[str, Any]) -> str:
    """Text of `metadata.yaml`, which has the metadata below a name of its own."""
    return yaml.safe_dump({"rosbag2_bagfile_information": metadata}, sort_keys=False)


def metadata_record(metadata: Mapping[str, Any]) -> dict[str, str]:
    """The same in an MCAP file, where rosbag2 looks for it before anything else, without a name."""
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
