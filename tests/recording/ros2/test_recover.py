"""The valid part of a damaged recording becomes a complete recording."""

import random
import re
import tracemalloc
from collections import Counter

import pytest
from command_line import invoke, succeed
from mcap.data_stream import ReadDataStream
from mcap.records import Chunk, Message
from mcap.stream_reader import breakup_chunk
from twin_recording import NAMESPACE, chunks, messages

from planetary_twin_py.recording.container.records import RecordingError, records_of
from planetary_twin_py.recording.ros2.playback import Playback
from planetary_twin_py.recording.ros2.recover import recover
from planetary_twin_py.recording.runs.info import read_info
from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.recording.runs.verify import verify


def lost_chunks(file, begin, end):
    """Messages of the chunks that have a byte from `begin` up to `end`, by mcap's own index."""
    lost = Counter()
    with file.open("rb") as stream:
        for index in chunks(file):
            place = index.chunk_start_offset
            if place < end and begin < place + index.chunk_length:
                stream.seek(place + 9)
                chunk = Chunk.read(ReadDataStream(stream))
                lost.update(keys(breakup_chunk(chunk)))
    return lost


def keys(records):
    """Keys that identify the messages of a recording."""
    return [(m.log_time, m.sequence, m.data) for m in records if isinstance(m, Message)]


def damages(size, count):
    """A kind of damage, and its first byte: one in six at the ends, where the structure is."""
    chance = random.Random(17)
    for number in range(count):
        ends = (*range(8, 60), *range(size - 60, size))
        place = chance.randrange(size) if number % 6 else chance.choice(ends)
        yield ("flip", "cut out", "cut off")[number % 3], place, chance.randrange(8)


def damaged(whole, kind, place, bit):
    if kind == "flip":
        return whole[:place] + bytes([whole[place] ^ 1 << bit]) + whole[place + 1 :]
    return whole[:place] + (whole[place + 1 :] if kind == "cut out" else b"")


@pytest.mark.parametrize("share", [0.4, 0.6, 0.95])
def test_a_truncated_file_keeps_all_its_valid_messages(sound, tmp_path, share):
    whole = sound.read_bytes()
    truncated = tmp_path / "truncated.mcap"
    truncated.write_bytes(whole[: int(share * len(whole))])
    saved = recover(truncated, tmp_path / "saved")
    assert list(records_of(saved.file, remarks := [])) and remarks == []
    kept = messages(saved.file)
    assert len(kept) == sum(saved.messages.values()) > 30
    assert kept == messages(sound)[: len(kept)]
    assert "is truncated" in saved.remarks[0]
    verdict = verify(saved.file.parent, NAMESPACE)
    assert verdict.identical


def played(file, count):
    """Remarks of a playback, or one that it has all of `count` messages."""
    playback = Playback(file)
    complete = len(list(playback.messages())) == count
    return playback.remarks or complete * ["complete"]


def test_damage_costs_its_chunk_and_every_reader_reports_it(sound, tmp_path):
    whole = sound.read_bytes()
    file = tmp_path / "damaged.mcap"
    there = Counter((log, number, data) for _, log, _, number, data in messages(sound))
    for kind, place, bit in damages(len(whole), 60):
        file.write_bytes(damaged(whole, kind, place, bit))
        end = len(whole) if kind == "cut off" else place + 1
        expected = there - lost_chunks(sound, place, end)
        found, remarks = Counter(), []
        try:
            found.update(keys(records_of(file, remarks)))
        except RecordingError as refusal:
            remarks.append(str(refusal))
        assert found - there == Counter() and expected - found == Counter(), (kind, place, bit)
        assert remarks and not any("\n" in line for line in remarks), (kind, place, bit)
        for read in (read_recording, read_info, lambda file: played(file, there.total())):
            try:
                found = read(file)
                assert getattr(found, "remarks", found), (read, kind, place, bit)
            except RecordingError as refusal:
                assert "\n" not in str(refusal)
        try:
            assert not verify(file, NAMESPACE).identical, (kind, place, bit)
        except RecordingError as refusal:
            assert "\n" not in str(refusal)


def test_damage_is_reported_with_its_time_and_messages(sound, tmp_path):
    first, _, index, *_, last = chunks(sound)
    truncated = tmp_path / "truncated.mcap"
    place = index.chunk_start_offset + index.chunk_length // 2
    truncated.write_bytes(damaged(sound.read_bytes(), "flip", place, 3))
    saved = recover(truncated, tmp_path / "saved")
    lost = lost_chunks(sound, place, place + 1)
    kept = messages(saved.file)
    assert kept == [m for m in messages(sound) if (m[1], m[3], m[4]) not in lost]
    assert kept[-1][1] == last.message_end_time
    (remark,) = saved.remarks
    assert f"{index.chunk_length} bytes from byte {index.chunk_start_offset} are skipped" in remark
    assert f"1 chunk, {lost.total()} messages by the index" in remark
    begin, end = map(float, re.search(r"from (\S+) to (\S+) s", remark).groups())
    start = first.message_start_time
    assert begin <= (index.message_start_time - start) * 1e-9 + 5e-4
    assert end >= (index.message_end_time - start) * 1e-9 - 5e-4


@pytest.mark.parametrize("field", [1, 25])  # length of a chunk in the file, and unpacked
def test_an_absurd_size_is_refused_before_memory_is_taken(sound, tmp_path, field):
    _, index, *_ = chunks(sound)
    place, data = index.chunk_start_offset, bytearray(sound.read_bytes())
    data[place + field : place + field + 8] = (2**36).to_bytes(8, "little")
    file = tmp_path / "absurd.mcap"
    file.write_bytes(data)
    expected = Counter(keys(records_of(sound, []))) - lost_chunks(sound, place, place + 1)
    tracemalloc.start()
    found = Counter(keys(records_of(file, remarks := [])))
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert found == expected and len(remarks) == 1 and most < 100e6


def test_the_command_reports_losses_and_overwrites_nothing(sound, tmp_path):
    truncated = tmp_path / "truncated.mcap"
    truncated.write_bytes(sound.read_bytes()[:-5000])
    answer = succeed("recover", truncated)
    assert "unreadable" in answer.output
    assert "gearbox_state" in answer.output
    elsewhere = tmp_path / "elsewhere"
    succeed("recover", str(truncated), "--out", elsewhere)
    assert messages(next(elsewhere.glob("*.mcap"))) == messages(
        next(tmp_path.glob("truncated_*/*.mcap"))
    )
    again = invoke("recover", truncated)
    assert again.exit_code == 2
    assert len(again.output.strip().splitlines()) == 1
    assert "exists" in again.output
