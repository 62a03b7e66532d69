"""Bags of other recorders are readable, or the refusal says how to convert them."""

import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from altered_recording import messages_of, rewritten, string
from mcap.reader import make_reader
from mcap.records import Message
from mcap.stream_reader import StreamReader
from mcap.writer import Writer as McapWriter
from rosbags.rosbag2 import CompressionFormat, CompressionMode, Reader, StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore
from tiers import first_rows
from twin_recording import NAMESPACE

from planetary_twin_py.recording.container.bag_folder import how_stored
from planetary_twin_py.recording.container.records import RecordingError
from planetary_twin_py.recording.ros2.playback import Playback
from planetary_twin_py.recording.ros2.recover import recover
from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.recording.runs.verify import verify


def stored(source, folder, plugin, mode=None):
    """The messages of a recording in a bag written by rosbags, without attachments."""
    types = get_typestore(Stores.ROS2_JAZZY)
    bag = Writer(folder, version=9, storage_plugin=plugin)
    if mode is not None:
        bag.set_compression(mode, CompressionFormat.ZSTD)
    with Reader(source.parent) as reader, bag as out:
        made = {
            c.id: out.add_connection(
                c.topic, c.msgtype, typestore=types, msgdef=c.msgdef.data, rihs01=c.digest
            )
            for c in reader.connections
        }
        for connection, time, data in reader.messages():
            out.write(made[connection.id], time, data)
    return folder


@pytest.mark.parametrize(
    ("plugin", "mode", "reason"),
    first_rows(
        1,
        [
            (StoragePlugin.SQLITE3, "FILE", "a bag in SQLite, compressed by file;"),
            (StoragePlugin.SQLITE3, None, "a bag in SQLite;"),
            (StoragePlugin.MCAP, "FILE", "a bag compressed by file;"),
        ],
    ),
)
def test_the_suggested_conversion_makes_a_bag_readable(
    sound, tmp_path, monkeypatch, plugin, mode, reason
):
    chosen = mode and CompressionMode[mode]
    folder = stored(sound, tmp_path / "bag", plugin, chosen)
    monkeypatch.chdir(tmp_path)
    with pytest.raises(RecordingError) as refusal:
        read_recording(Path("bag"))
    assert f"bag: {reason}" in str(refusal.value) and "\n" not in str(refusal.value)
    command = str(refusal.value).partition("; to convert it: ")[2]
    name, *arguments = shlex.split(command)
    subprocess.run([Path(sys.executable).with_name(name), *arguments], check=True)
    assert len(read_recording(Path("bag_mcap")).state) == len(read_recording(sound).state)
    assert verify(Path("bag_mcap"), NAMESPACE).identical
    assert how_stored(folder) is not None and how_stored(Path("bag_mcap")) is None


def test_a_bag_compressed_by_message_is_readable(sound, tmp_path):
    folder = stored(sound, tmp_path / "bag", StoragePlugin.MCAP, CompressionMode.MESSAGE)
    (file,) = folder.glob("*.mcap")
    alone = shutil.copy(file, tmp_path / "alone.mcap")
    with sound.open("rb") as stream:
        published = [m.data for m in StreamReader(stream).records if isinstance(m, Message)]
    for path in (folder, alone):
        assert [message.data for message in Playback(path).messages()] == published
        assert len(read_recording(path).state) == len(read_recording(sound).state)
        assert verify(path, NAMESPACE).identical
    recovered = recover(alone, tmp_path / "recovered")
    assert verify(recovered.file, NAMESPACE).identical


def test_an_unreadable_origin_leaves_other_runs_to_verify(sound, tmp_path):
    first = True

    def spoil(data):
        nonlocal first
        first, spoiled = False, first
        return string("begins: 1\n") if spoiled else data

    file = rewritten(sound, tmp_path / "bad.mcap", messages_of("run_origin", spoil))
    verdict = verify(file, NAMESPACE)
    assert verdict.first_difference is None and not verdict.identical
    assert verdict.messages["gearbox_state"] == 10  # of the second run
    assert any("run_origin" in remark for remark in verdict.remarks)
    assert any("31 intervals of a run whose start or origin" in line for line in verdict.remarks)


def test_a_file_whose_summary_repeats_no_channels_is_read(sound, tmp_path):
    path, ids = tmp_path / "short_summary.mcap", {}
    with path.open("wb") as file:
        writer = McapWriter(file, repeat_channels=False)
        writer.start("ros2")
        for schema, channel, message in make_reader(sound.open("rb")).iter_messages():
            if channel.topic not in ids:
                number = writer.register_schema(schema.name, schema.encoding, schema.data)
                ids[channel.topic] = writer.register_channel(
                    channel.topic, channel.message_encoding, number, channel.metadata
                )
            writer.add_message(
                ids[channel.topic], message.log_time, message.data, message.publish_time
            )
        writer.finish()
    published = [message.data for message in Playback(sound).messages()]
    assert [message.data for message in Playback(path).messages()] == published
