"""metadata.yaml of a split bag has each field that rosbag2 reads, with the type that it expects.

Types, names and words are those of the decoders in rosbag2 0.29 (rosbag2_storage: yaml.hpp,
qos.cpp, metadata_io.cpp; rosbag2_cpp: sequential_reader.cpp). rosbag2 itself is not run here.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import yaml
from mcap.reader import make_reader
from twin_recording import record

from planetary_twin_py.recording.container.storage import Storage

UINT64, INT32 = range(2**64), range(-(2**31), 2**31)
UNKNOWN = ["system_default", "unknown"]
TIME = {"sec": UINT64, "nsec": UINT64}
SPAN = {
    "starting_time": {"nanoseconds_since_epoch": UINT64},
    "duration": {"nanoseconds": UINT64},
    "message_count": UINT64,
}
QOS = {
    "history": ("keep_last", "keep_all", *UNKNOWN),
    "depth": INT32,
    "reliability": ("reliable", "best_effort", *UNKNOWN),
    "durability": ("volatile", "transient_local", *UNKNOWN),
    "deadline": TIME,
    "lifespan": TIME,
    "liveliness": ("automatic", "manual_by_topic", *UNKNOWN),
    "liveliness_lease_duration": TIME,
    "avoid_ros_namespace_conventions": bool,
}
TOPIC = {
    "name": str,
    "type": str,
    "serialization_format": ("cdr",),
    "offered_qos_profiles": [QOS],
    "type_description_hash": str,
}
FIELDS = {
    "version": (9,),
    "storage_identifier": ("mcap",),
    **SPAN,
    "topics_with_message_count": [{"topic_metadata": TOPIC, "message_count": UINT64}],
    "relative_file_paths": [str],
    "compression_format": str,
    "compression_mode": ("",),
    "files": [{"path": str, **SPAN}],
    "custom_data": (None,),  # or texts by name
    "ros_distro": str,
}
"""Types, ranges, or possible words; a list has elements of one kind."""


def assert_as(expected: Any, value: Any, name: str = "") -> None:
    """The value is what rosbag2 expects; it reads no other fields of a mapping."""
    if isinstance(expected, dict):
        for field, of_field in expected.items():
            assert_as(of_field, value[field], f"{name}.{field}")
    elif isinstance(expected, list):
        assert type(value) is list, name
        for each in value:
            assert_as(expected[0], each, name)
    elif isinstance(expected, type):
        assert type(value) is expected, name
    else:
        assert type(value) is type(expected[0]) and value in expected, (name, value)


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
        assert_as(FIELDS, given)


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
