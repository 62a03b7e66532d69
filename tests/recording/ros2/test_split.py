"""A split bag loses nothing between its files, and each is enough for itself."""

from pathlib import Path

import pytest
import yaml
from command_line import invoke
from mcap.reader import make_reader
from numbered import (
    COMPRESSIONS,
    NUMBERS,
    PERIOD,
    SETTINGS,
    START,
    Numbered,
    number_of,
    payload,
    read_numbers,
)
from rosbags.rosbag2 import Reader
from twin_recording import NAMESPACE, chunks, record

from planetary_twin_py.recording.container.storage import Storage
from planetary_twin_py.recording.ros2.account import TopicAccount
from planetary_twin_py.recording.ros2.bag import ACCOUNT_RECORD, CLOCKS_RECORD, BagWriter
from planetary_twin_py.recording.ros2.playback import Playback
from planetary_twin_py.recording.ros2.recover import recover
from planetary_twin_py.recording.ros2.ring import Ring
from planetary_twin_py.recording.runs.info import read_info
from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.recording.runs.verify import verify


def _files(folder: Path) -> list[Path]:
    return [folder / f"{folder.name}_{k}.mcap" for k in range(len(list(folder.glob("*.mcap"))))]


def _split(folder: Path, storage: Storage | None = None) -> Path:
    """Three files, with one setting in all of them and another from the second on."""
    numbered = Numbered(folder, storage)
    numbered.bag.attach("scene.yaml", b"paper", "application/yaml")
    numbered.bag.describe("software", {"python": "3"})
    numbered.settle(1)
    numbered.write(100)
    numbered.bag.split()
    numbered.write(50)
    numbered.settle(2)
    numbered.bag.split()
    numbered.write(10)
    numbered.bag.close()
    return folder


@pytest.mark.parametrize("compression", COMPRESSIONS)
def test_each_file_is_complete_and_self_contained(tmp_path, compression):
    folder = _split(tmp_path / "bag", Storage(compression=compression))
    numbers, settings = [], []
    for file in _files(folder):
        with file.open("rb") as stream:
            reader = make_reader(stream, validate_crcs=True)
            messages = [(c.topic, number_of(m.data)) for _, c, m in reader.iter_messages()]
            assert [a.name for a in reader.iter_attachments()] == ["scene.yaml"]
            assert "software" in [m.name for m in reader.iter_metadata()]
            chunks = reader.get_summary().chunk_indexes
        assert {chunk.compression for chunk in chunks} == {compression.replace("none", "")}
        numbers += [value for topic, value in messages if topic == "/numbers"]
        settings.append([value for topic, value in messages if topic == "/settings"])
    assert numbers == list(range(1, 161))
    assert settings == [[1], [1, 2], [2]]


def test_the_folder_lists_its_files_as_rosbag2_does(tmp_path):
    folder = _split(tmp_path / "bag")
    metadata = yaml.safe_load((folder / "metadata.yaml").read_text())["rosbag2_bagfile_information"]
    assert metadata["relative_file_paths"] == [file.name for file in _files(folder)]
    assert [file["message_count"] for file in metadata["files"]] == [101, 52, 11]
    begins = [file["starting_time"]["nanoseconds_since_epoch"] for file in metadata["files"]]
    spans = [file["duration"]["nanoseconds"] for file in metadata["files"]]
    assert begins == [START, START + 100 * PERIOD, START + 150 * PERIOD]
    assert spans == [100 * PERIOD, 50 * PERIOD, 10 * PERIOD]
    assert metadata["duration"]["nanoseconds"] == 160 * PERIOD
    topics = [topic["message_count"] for topic in metadata["topics_with_message_count"]]
    assert metadata["message_count"] == sum(topics) == 164
    with Reader(folder) as reader:
        messages = list(reader.messages())
        assert reader.message_count == len(messages) == 164
        assert {c.topic: c.msgcount for c in reader.connections} == {
            "/numbers": 160,
            "/settings": 4,
        }


def test_reading_the_whole_bag_gives_each_message_once(tmp_path):
    folder = _split(tmp_path / "bag")
    info = read_info(folder)
    assert {name: topic.recorded for name, topic in info.topics.items()} == {
        "/numbers": 160,
        "/settings": 2,
    }
    messages = [(message.topic, number_of(message.data)) for message in Playback(folder).messages()]
    assert [value for topic, value in messages if topic == "/settings"] == [1, 2]
    assert [value for topic, value in messages if topic == "/numbers"] == list(range(1, 161))
    saved = recover(folder, tmp_path / "saved")
    assert saved.messages == {"/numbers": 160, "/settings": 2}
    assert saved.remarks == []


@pytest.mark.parametrize("written", [0, 5])
def test_a_file_just_started_before_a_kill_does_no_harm(tmp_path, written):
    folder = _split(tmp_path / "bag")
    (folder / "metadata.yaml").unlink()
    last = _files(folder)[-1]
    last.write_bytes(last.read_bytes()[:written])
    saved = recover(folder, tmp_path / "saved")
    assert read_numbers(saved.file) == list(range(1, 151))
    assert saved.remarks == [f"{last.name}: ends after {written} bytes, before any message"]
    assert read_info(folder).topics["/numbers"].recorded == 150
    assert sum(message.topic == "/numbers" for message in Playback(folder).messages()) == 150


@pytest.mark.parametrize(
    ("limit", "count"), [({"split_duration": 0.05}, 4), ({"split_size": 0.02}, 10)]
)
def test_files_end_at_their_limit(tmp_path, limit, count):
    numbered = Numbered(tmp_path / "bag", Storage("none", chunk_size=0.001, **limit), size=1000)
    numbered.write(200)
    numbered.bag.close()
    files = _files(tmp_path / "bag")
    assert len(files) == count if "split_duration" in limit else len(files) >= count
    assert [number for file in files for number in read_numbers(file)] == list(range(1, 201))
    if "split_size" in limit:
        assert all(file.stat().st_size < 30_000 for file in files)


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("compression", "gzip"),
        ("chunk_size", 0.0),
        ("split_duration", float("nan")),
    ],
)
def test_an_invalid_storage_setting_is_refused(field, value):
    with pytest.raises(ValueError, match=f"^{field} = "):
        Storage(**{field: value})


def test_accounts_of_all_files_add_up(tmp_path):
    bag = BagWriter(tmp_path / "bag", clocks=lambda: {"system": "1"})
    account = TopicAccount()
    channel = bag.add_topic(NUMBERS, account)
    for number in (1, 3):
        account.receive(number)
        bag.write(channel, payload(number), START + number, START, number)
    bag.split()
    for number in (4, 8):
        account.receive(number)
        bag.write(channel, payload(number), START + number, START, number)
    bag.close()
    lost, clocks = [], []
    for file in _files(tmp_path / "bag"):
        with file.open("rb") as stream:
            found = [(r.name, r.metadata) for r in make_reader(stream).iter_metadata()]
        lost += [int(values["lost"]) for name, values in found if name == ACCOUNT_RECORD]
        clocks.append([name for name, _ in found].count(CLOCKS_RECORD))
    assert lost == [1, 3]
    assert clocks == [2, 2]
    assert read_info(tmp_path / "bag").topics["/numbers"].lost == 4


def test_recorded_messages_that_cannot_be_read_count_as_lost(tmp_path):
    bag, account = BagWriter(tmp_path / "bag", Storage(chunk_size=0.001)), TopicAccount()
    channel = bag.add_topic(NUMBERS, account)
    for number in range(1, 1001):
        account.receive(number)
        bag.write(channel, payload(number), START + number * PERIOD, START, number)
    bag.close()
    (file,) = _files(tmp_path / "bag")
    _, chunk, *_ = chunks(file)
    data = bytearray(file.read_bytes())
    data[chunk.chunk_start_offset + chunk.chunk_length // 2] ^= 1
    file.write_bytes(data)
    saved = recover(file, tmp_path / "saved")
    kept = saved.messages["/numbers"]
    assert 0 < kept < 1000
    for found in (file, saved.file):
        topic = read_info(found).topics["/numbers"]
        assert (topic.recorded, topic.lost) == (kept, 1000 - kept)


def test_a_split_recording_is_read_as_a_whole(tmp_path):
    split = record(tmp_path / "split", storage=Storage(split_duration=0.1)).parent
    whole = record(tmp_path / "whole").parent
    assert len(_files(split)) > 3
    assert verify(split, NAMESPACE).identical
    assert verify(split, NAMESPACE).messages == verify(whole, NAMESPACE).messages
    shown, expected = (read_recording(path) for path in (split, whole))
    assert shown.state.time.tolist() == expected.state.time.tolist()
    assert shown.operating_point.time.tolist() == expected.operating_point.time.tolist()
    assert len(shown.waveform.time) == len(expected.waveform.time)
    answers = [invoke("info", path) for path in (split, whole)]
    assert all(answer.exit_code == 0 for answer in answers)
    # Every file contains the latest operating point.
    assert len(read_recording(_files(split)[2]).operating_point) >= 1


def test_a_snapshot_has_the_last_seconds_and_latched_messages(tmp_path):
    ring = Ring(0.1)
    ring.attach("scene.yaml", b"paper", "application/yaml")
    numbers, settings = (ring.add_topic(t, TopicAccount()) for t in (NUMBERS, SETTINGS))
    for value in (1, 2):
        ring.write(settings, payload(value), START, START + value, value)
    for value in range(1000):
        if value != 950:
            time = START + value * PERIOD
            ring.write(numbers, payload(value), time, time, value)
    assert ring.size == 100 * len(payload(0))
    bag = BagWriter(tmp_path / "bag")
    ring.write_to(bag)
    bag.close()
    assert read_numbers(bag.file) == [v for v in range(899, 1000) if v != 950]
    assert read_numbers(bag.file, "/settings") == [2]
    info = read_info(tmp_path / "bag").topics
    assert (info["/numbers"].lost, info["/settings"].lost) == (1, 0)
    assert info["/settings"].first == START + 899 * PERIOD


@pytest.mark.parametrize("lost", [0, 2, "last"])
@pytest.mark.parametrize("listed", [True, False])
def test_every_reader_names_a_missing_file(tmp_path, lost, listed):
    split = record(tmp_path / "split", storage=Storage(split_duration=0.1)).parent
    files = _files(split)
    missing = files[-1] if lost == "last" else files[lost]
    missing.unlink()
    if not listed:
        (split / "metadata.yaml").unlink()
        if lost == "last":
            return  # nothing shows that there were more files
    named = f"{missing.name} missing, 1 of its"
    remarks = {
        "info": read_info(split).remarks,
        "recover": recover(split, tmp_path / "saved").remarks,
        "view": read_recording(split).remarks,
        "replay": Playback(split).remarks,
    }
    for reader, lines in remarks.items():
        assert any(named in line for line in lines), reader
    assert {topic.lost for topic in read_info(split).topics.values()} == {None}
    answer = invoke("verify", split)
    assert answer.exit_code == 1
    assert named in answer.output
    assert not answer.output.endswith("identical bit for bit\n")
