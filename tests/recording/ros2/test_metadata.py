"""metadata.yaml of a split bag has each field that rosbag2 reads, with the type that it expects.

Types, names and words are those of the decoders in rosbag2 0.29 (rosbag2_storage: yaml.hpp,
qos.cpp, metadata_io.cpp; rosbag2_cpp: sequential_reader.cpp). rosbag2 itself is not run here.
"""

from pathlib import Path
from typing import Any

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


def test_each_field_is_as_rosbag2_reads_it(tmp_path: Path) -> None:
    """Of the folder and of each file, which rosbag2 reads without metadata.yaml."""
    folder = tmp_path / "bag"
    record(folder, storage=Storage(split_size=0.1))
    of_folder = yaml.safe_load((folder / "metadata.yaml").read_text())
    every = [of_folder["rosbag2_bagfile_information"]]  # metadata_io.cpp: below this name
    for file in folder.glob("*.mcap"):
        with file.open("rb") as stream:
            (found,) = [r for r in make_reader(stream).iter_metadata() if r.name == "rosbag2"]
        every.append(yaml.safe_load(found.metadata["serialized_metadata"]))
    assert len(every) > 2
    for given in every:
        assert_as(FIELDS, given)
