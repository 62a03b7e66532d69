"""A file damaged anywhere is read as it was written, or the damage is reported."""

import os
import shutil
import struct

import numpy as np
import pytest
from mcap.exceptions import EndOfFile
from synthetic_recording import START_NS
from tiers import first
from twin_recording import NAMESPACE

import planetary_twin_py as pt
from planetary_twin_py.recording.container.damage import Damages
from planetary_twin_py.recording.container.integrity import MAGIC
from planetary_twin_py.recording.container.records import RecordingError, records_of
from planetary_twin_py.recording.container.walk import Lost
from planetary_twin_py.recording.ros2.bag import BagWriter
from planetary_twin_py.recording.ros2.definitions import topics_of
from planetary_twin_py.recording.ros2.playback import Playback
from planetary_twin_py.recording.ros2.recover import recover
from planetary_twin_py.recording.ros2.topics import ORIGIN, POINT, STATE
from planetary_twin_py.recording.runs.compose import Composer
from planetary_twin_py.recording.runs.info import read_info
from planetary_twin_py.recording.runs.origin import Origin, makers_here
from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.recording.runs.verify import verify

SCENE = "base: paper\n"
CHUNK = 6  # opcode
CHUNK_HEAD = 8 + 8 + 8 + 4  # times, size and checksum, before the name of the compression


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    """Ten intervals in two chunks, on the topics that define a run."""
    bag = BagWriter(tmp_path_factory.mktemp("sound") / "bag")
    names = [f"{NAMESPACE}/{name}" for name in (ORIGIN, POINT, STATE)]
    topics = [topic for topic in topics_of(NAMESPACE) if topic.name in names]
    composer = Composer(bag, topics, NAMESPACE)
    twin = pt.Twin(pt.load_scene("paper"), 10_000.0, 1e-2)
    bag.attach("scene.yaml", SCENE.encode(), "application/yaml")
    composer.begin(Origin(twin.scene, START_NS, makers_here()))
    composer.point(twin.log[-1].values, 0.0, START_NS)
    for number in range(1, 11):
        window = twin.advance(0.01)
        composer.window(window, START_NS + round(window.end * 1e9), 0)
        if number == 6:
            bag.flush()
    bag.close()
    return bag.file


def records(data):
    """Opcode, offset and end of every record in the file itself."""
    place = len(MAGIC)
    while place < len(data) - len(MAGIC):
        opcode, length = struct.unpack_from("<BQ", data, place)
        yield opcode, place, place + 9 + length
        place += 9 + length


def places(data):
    """Offsets of the structure of a file, above all the head, start and end of each record."""
    found = {0, len(MAGIC) - 1, len(data) - len(MAGIC), len(data) - 1}
    for opcode, begin, end in records(data):
        content = begin + 9
        found |= {begin, begin + 1, begin + 4, content - 1, content, content + 8}
        found |= {(content + end) // 2, end - 4, end - 1}
        if opcode == CHUNK:
            named = content + CHUNK_HEAD
            (length,) = struct.unpack_from("<I", data, named)
            packed = named + 4 + length
            found |= {content + 16, content + 24, named, named + 4, packed, packed + 8, packed + 20}
    return sorted(place for place in found if place < len(data))


@pytest.mark.parametrize("checksum", [True, False])
def test_a_chunk_whose_stated_length_is_damaged_is_kept_if_its_checksum_is_right(
    sound, tmp_path, checksum
):
    whole, original = sound.read_bytes(), list(records_of(sound, []))
    for opcode, begin, _ in records(whole):
        if opcode != CHUNK:
            continue
        data, named = bytearray(whole), begin + 9 + CHUNK_HEAD
        (length,) = struct.unpack_from("<I", data, named)
        data[named + 4 + length + 4] ^= 4  # 16 GB more
        if not checksum:
            data[named - 4 : named] = bytes(4)  # then nothing shows that the data are whole
        damaged = tmp_path / "damaged.mcap"
        damaged.write_bytes(data)
        found = list(records_of(damaged, remarks := []))
        assert (found == original) == checksum
        assert remarks  # the checksum of all data is wrong


def flipped(data, place, bit):
    damaged = bytearray(data)
    damaged[place] ^= 1 << bit
    return bytes(damaged)


def damages(data):
    """Every damage that is tested, with its name."""
    for number, place in enumerate(places(data)):
        bit = (0, 5, 7)[number % 3]
        yield f"bit {bit} of byte {place}", flipped(data, place, bit)
        yield f"cut at {place}", data[:place]


def values(file, remarks=()):
    """The values that the reader returns, and its remarks without those of the sound file."""
    recording = read_recording(file)
    remarks = [*remarks, *recording.remarks]
    # If the attachment is reported as lost, the scene is that of `run_origin`.
    assert recording.scene_yaml in (SCENE, None) or remarks
    series = (recording.state, recording.operating_point)
    rows = [
        tuple(np.asarray(one[name][row]).tobytes() for name in one.columns)
        for one in series
        for row in range(len(one))
    ]
    return rows, remarks


def counted(file):
    info = read_info(file)
    return [info.topics, info.changes, info.simulated], info.remarks


def recovered(file):
    """The values that the reader returns for the recovered file."""
    folder = file.with_name("saved")
    shutil.rmtree(folder, ignore_errors=True)
    saved = recover(file, folder)
    return values(saved.file, saved.remarks)


def played(file):
    playback = Playback(file)
    messages = [(message.topic, message.data) for message in playback.messages()]
    return [playback.topics, messages], playback.remarks


@pytest.mark.slow
@pytest.mark.parametrize(
    "read",
    first(1, [values, counted, recovered, played]),
)
def test_data_is_read_as_written_or_the_damage_is_reported(sound, tmp_path, monkeypatch, read):
    monkeypatch.setattr(os, "fsync", lambda file: None)  # called too often
    whole, remarks = read(shutil.copy(sound, tmp_path / "whole.mcap"))
    assert remarks == []
    file, kept_silent, tried = tmp_path / "damaged.mcap", [], 0
    for name, content in damages(sound.read_bytes()):
        tried += 1
        file.write_bytes(content)
        try:
            found, remarks = read(file)
        except RecordingError as refusal:
            assert "\n" not in str(refusal)
            continue
        if found != whole and not remarks:
            kept_silent.append(name)
        if read is values and not any("may be wrong" in remark for remark in remarks):
            assert set(found) <= set(whole), name
    assert kept_silent == []
    assert tried > 400


def test_a_recording_that_verify_calls_identical_is_complete(sound, tmp_path):
    file = tmp_path / "damaged.mcap"
    assert verify(sound, NAMESPACE).identical
    for name, content in list(damages(sound.read_bytes()))[::29]:
        file.write_bytes(content)
        try:
            assert not verify(file, NAMESPACE).identical, name
        except RecordingError as refusal:
            assert "\n" not in str(refusal)


def test_a_file_that_grows_while_it_is_read_is_still_being_written(tmp_path):
    file = tmp_path / "growing.mcap"
    file.write_bytes(MAGIC)
    found = Damages(file)
    file.write_bytes(MAGIC + bytes(10))
    grown = file.stat().st_size
    found.add_lost(Lost(grown, grown, 0, EndOfFile()))
    assert found.remarks() == [
        "growing.mcap: has no end record: the recorder is still writing, or was killed; "
        "everything before is intact"
    ]
