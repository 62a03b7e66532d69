"""A bag folder is readable by other tools, never overwritten, and survives a truncated end."""

import struct
from pathlib import Path

import pytest
import yaml
from mcap.reader import make_reader
from numbered import NUMBERS

from planetary_twin_py.recording.ros2.account import TopicAccount
from planetary_twin_py.recording.ros2.bag import (
    ACCOUNT_RECORD,
    BagWriter,
    named_folder,
)
from planetary_twin_py.recording.ros2.schema import message_definition

_TYPES = {
    "demo_msgs/msg/Reading": "# a comment\nstd_msgs/Header header\nfloat64[<=3] v\nPart[2] parts\n",
    "std_msgs/msg/Header": "builtin_interfaces/Time stamp\nstring frame_id\n",
    "builtin_interfaces/msg/Time": "int32 sec\nuint32 nanosec\n",
    "demo_msgs/msg/Part": "uint8 SMALL=1\nstring<=8 name\n",
}


def _number(value: float) -> bytes:
    return b"\x00\x01\x00\x00" + struct.pack("<d", value)


def _write(bag: BagWriter, channel: int, values: range) -> None:
    for value in values:
        bag.write(channel, _number(value), 1000 + value, 900 + value, value + 1)


def test_a_definition_contains_every_type_it_refers_to() -> None:
    text = message_definition("demo_msgs/msg/Reading", _TYPES.__getitem__)
    headings = [line for line in text.splitlines() if line.startswith("MSG: ")]
    assert text.startswith(_TYPES["demo_msgs/msg/Reading"])
    assert headings == [
        "MSG: std_msgs/Header",
        "MSG: demo_msgs/Part",
        "MSG: builtin_interfaces/Time",
    ]
    assert text.count("=" * 80) == 3


def test_the_file_contains_the_message_counts_and_both_times(tmp_path: Path) -> None:
    bag = BagWriter(tmp_path / "bag")
    _write(bag, bag.add_topic(NUMBERS, TopicAccount(recorded=3, missed=2)), range(3))
    bag.close()
    with bag.file.open("rb") as stream:
        reader = make_reader(stream)
        _, _, first = next(iter(reader.iter_messages()))
        records = {record.name: record.metadata for record in reader.iter_metadata()}
        assert reader.get_header().profile == "ros2"
    assert (first.log_time, first.publish_time, first.sequence) == (1000, 900, 1)
    assert records[ACCOUNT_RECORD]["lost"] == "2"
    # rosbag2 decodes this at once, and refuses a file with another mapping.
    metadata = yaml.safe_load(records["rosbag2"]["serialized_metadata"])
    assert metadata["version"] == 9 and metadata["message_count"] == 3
    written = yaml.safe_load((tmp_path / "bag" / "metadata.yaml").read_text())
    assert written == {"rosbag2_bagfile_information": metadata}


def test_an_existing_recording_is_never_overwritten(tmp_path: Path) -> None:
    BagWriter(tmp_path / "bag").close()
    with pytest.raises(FileExistsError):
        BagWriter(tmp_path / "bag")


@pytest.mark.parametrize(
    "name", ["", ".", "..", "a/b", "/a", "../a", "a/", "a\0b", "a\nb", "\u00e9" * 101]
)
def test_a_name_that_is_not_plain_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(ValueError, match="must be a plain name"):
        named_folder(tmp_path, name)
    assert named_folder(tmp_path, "ein Lauf.1") == tmp_path / "ein Lauf.1"
