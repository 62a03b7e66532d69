"""A recording tells what it holds, what it lacks, and what was changed when."""

import json

import pytest
from mcap.records import Message
from twin_recording import NAMESPACE, record
from typer.testing import CliRunner

from planetary_twin_py.cli import build_app
from planetary_twin_py.recording.index import Index
from planetary_twin_py.recording.info import read_info
from planetary_twin_py.recording.records import records_of


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    return record(tmp_path_factory.mktemp("sound") / "bag")


def test_topics_rates_and_gaps_are_those_that_were_written(sound):
    info = read_info(sound.parent)
    state = info.topics[f"{NAMESPACE}/gearbox_state"]
    assert (state.type, state.recorded) == ("planetary_twin_msgs/msg/GearboxState", 41)
    assert state.rate == pytest.approx(40 / 1.09)
    assert state.longest_gap == pytest.approx(0.7099e9)  # from 0.3001 s to the next run's 1.01 s
    assert info.topics[f"{NAMESPACE}/run_origin"].recorded == 2
    assert info.simulated == pytest.approx(0.4001)
    assert info.remarks == []


def test_changes_are_told_with_their_instants(sound):
    first, second, third = read_info(sound).changes
    assert first.time == 0.0 and len(first.values) == 7
    assert second.time == pytest.approx(0.1)
    assert second.values == {"backlash": 3e-7, "lambda_ratio": 1.5}
    assert third.values == {"backlash": 2e-7, "lambda_ratio": 1.0, "input_speed": 150.0}


def test_the_command_prints_them_and_its_figures_are_those_of_a_run(sound, tmp_path):
    answer = CliRunner().invoke(
        build_app(), ["info", str(sound), "--json", str(tmp_path / "figures.json")]
    )
    assert answer.exit_code == 0, answer.output
    assert "backlash = 3e-07 m, lambda_ratio = 1.5" in answer.output
    figures = json.loads((tmp_path / "figures.json").read_text())
    assert set(figures) == {"topics", "duration_s", "real_time_factor", "overruns", "file"}
    assert figures["topics"][f"{NAMESPACE}/joint_states"]["recorded"] == 41


def test_what_is_no_recording_is_refused_in_one_line(tmp_path):
    answer = CliRunner().invoke(build_app(), ["info", str(tmp_path)])
    assert answer.exit_code == 2
    assert len(answer.output.strip().splitlines()) == 1


def without_index(file):
    raise ValueError("no index")


def test_the_index_of_a_file_tells_the_same_as_all_its_records(tmp_path, monkeypatch):
    def lose(topic, number, row):
        return None if topic == "gearbox_state" and number in (7, 8, 20) else row

    file = record(tmp_path / "bag", lose)
    by_index = read_info(file)
    monkeypatch.setattr("planetary_twin_py.recording.info.Index", without_index)
    by_records = read_info(file)
    assert by_index.simulated == pytest.approx(by_records.simulated, rel=1e-12)
    by_index.simulated = by_records.simulated
    assert by_index == by_records


def test_the_index_leads_to_every_message(sound):
    index, found = Index(sound), {}
    for entry in records_of(sound, []):
        if isinstance(entry, Message):
            found.setdefault(entry.channel_id, []).append(entry)
    for channel, messages in found.items():
        assert index.times[channel].tolist() == [message.log_time for message in messages]
        for number, message in enumerate(messages):
            assert index.message(channel, number) == message


def test_a_file_without_a_sound_index_or_with_a_damaged_chunk_is_read_whole(sound, tmp_path):
    whole = sound.read_bytes()
    flipped = bytearray(whole)
    flipped[whole.index(b"zstd") + 100] ^= 1  # in the first chunk, which tells the operating point
    for name, data, remarks in (
        ("torn", whole[: len(whole) // 2], 1),
        ("cut", whole[:20], 1),
        ("damaged", bytes(flipped), 1),
        ("unsummed", whole[:-300] + bytes([whole[-300] ^ 1]) + whole[-299:], 0),
    ):
        file = tmp_path / f"{name}.mcap"
        file.write_bytes(data)
        assert len(read_info(file).remarks) == remarks
