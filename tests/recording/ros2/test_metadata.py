"""metadata.yaml of a split bag has each field that rosbag2 reads, with the type that it expects.

Types, names and words are those of the decoders in rosbag2 0.29 (rosbag2_storage: yaml.hpp,
qos.cpp, metadata_io.cpp; rosbag2_cpp: sequential_reader.cpp). rosbag2 itself is not run here.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml
from mcap.reader import make_reader
from twin_recording import record

from planetary_twin_py.recording.container.storage import Storage

Check = Callable[[Any], bool]


def uint64(value: Any) -> bool:
    return type(value) is int and 0 <= value < 2**64


def int32(value: Any) -> bool:
    return type(value) is int and -(2**31) <= value < 2**31


def text(value: Any) -> bool:
    return type(value) is str


def words(*known: str) -> Check:
    return lambda value: value in known


def node(**fields: Check) -> Check:
    """A mapping that has these fields; rosbag2 reads no others."""
    return lambda value: all(name in value and check(value[name]) for name, check in fields.items())


def each(check: Check) -> Check:
    return lambda value: type(value) is list and all(map(check, value))


def texts_by_name(value: Any) -> bool:
    return value is None or all(text(k) and text(v) for k, v in value.items())


TIME = node(sec=uint64, nsec=uint64)
QOS = node(
    history=words("keep_last", "keep_all", "system_default", "unknown"),
    depth=int32,
    reliability=words("reliable", "best_effort", "system_default", "unknown"),
    durability=words("volatile", "transient_local", "system_default", "unknown"),
    deadline=TIME,
    lifespan=TIME,
    liveliness=words("automatic", "manual_by_topic", "system_default", "unknown"),
    liveliness_lease_duration=TIME,
    avoid_ros_namespace_conventions=lambda value: type(value) is bool,
)
SPAN = {
    "starting_time": node(nanoseconds_since_epoch=uint64),
    "duration": node(nanoseconds=uint64),
    "message_count": uint64,
}
TOPIC = node(
    name=text,
    type=text,
    serialization_format=words("cdr"),
    offered_qos_profiles=each(QOS),
    type_description_hash=text,
)
FIELDS = {
    "version": words(9),
    "storage_identifier": words("mcap"),
    **SPAN,
    "topics_with_message_count": each(node(topic_metadata=TOPIC, message_count=uint64)),
    "relative_file_paths": each(text),
    "compression_format": text,
    "compression_mode": words(""),
    "files": each(node(path=text, **SPAN)),
    "custom_data": texts_by_name,
    "ros_distro": text,
}


@pytest.fixture(scope="module")
def split(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A bag of several files."""
    folder: Path = tmp_path_factory.mktemp("split") / "bag"
    record(folder, storage=Storage(split_size=0.1))
    assert len(list(folder.glob("*.mcap"))) > 1
    return folder


@pytest.fixture(scope="module")
def metadata(split: Path) -> dict[str, Any]:
    # metadata_io.cpp: everything is below this name.
    return dict(
        yaml.safe_load((split / "metadata.yaml").read_text())["rosbag2_bagfile_information"]
    )


def test_each_field_is_as_rosbag2_reads_it(split: Path, metadata: dict[str, Any]) -> None:
    """Without metadata.yaml, it reads each file."""
    every = [metadata]
    for file in split.glob("*.mcap"):
        with file.open("rb") as stream:
            (found,) = [r for r in make_reader(stream).iter_metadata() if r.name == "rosbag2"]
        every.append(yaml.safe_load(found.metadata["serialized_metadata"]))
    for given in every:
        assert [name for name, check in FIELDS.items() if not check(given[name])] == []


def test_the_files_exist_and_their_counts_add_up_to_the_total(
    split: Path, metadata: dict[str, Any]
) -> None:
    """It opens them in this order, below the folder."""
    paths = metadata["relative_file_paths"]
    assert [split / path for path in paths] == sorted(split.glob("*.mcap"))
    assert [file["path"] for file in metadata["files"]] == paths
    counts = [file["message_count"] for file in metadata["files"]]
    topics = [topic["message_count"] for topic in metadata["topics_with_message_count"]]
    assert metadata["message_count"] == sum(counts) == sum(topics) > 0
