"""The description of a recording: its contents, its gaps and the changes during the run."""

import json
import re
import tracemalloc

import numpy as np
import pytest
from command_line import invoke, succeed
from numbered import Numbered
from sensor_recording import RATE, record_twin
from twin_recording import NAMESPACE, START_NS, TwinRecording, chunks, record

import planetary_twin_py as pt
from planetary_twin_py.recording.container.message_index import Index
from planetary_twin_py.recording.ros2.bag import BagWriter
from planetary_twin_py.recording.ros2.recover import recover
from planetary_twin_py.recording.runs.contents import Changed
from planetary_twin_py.recording.runs.events import read_events
from planetary_twin_py.recording.runs.info import read_info
from planetary_twin_py.recording.runs.ramps import ramps
from planetary_twin_py.recording.runs.sampled_info import SampledInfo


def test_topics_rates_and_gaps_are_those_written(sound):
    info = read_info(sound.parent)
    state = info.topics[f"{NAMESPACE}/gearbox_state"]
    assert (state.type, state.recorded) == ("planetary_twin_msgs/msg/GearboxState", 41)
    assert state.rate == pytest.approx(40 / 1.09)
    assert state.longest_gap == pytest.approx(0.7099e9)  # from 0.3001 s to the next run's 1.01 s
    assert info.topics[f"{NAMESPACE}/run_origin"].recorded == 2
    assert info.simulated == pytest.approx(0.4001)
    assert info.remarks == []


def test_changes_are_listed_with_their_instants(sound):
    first, second, third = read_info(sound).changes
    assert first.time == 0.0
    assert first.values == pt.load_scene("paper").live_values
    assert second.time == pytest.approx(0.1)
    assert second.values == {"backlash": 3e-7, "lambda_ratio": 1.5}
    assert third.values == {"backlash": 2e-7, "lambda_ratio": 1.0, "input_speed": 150.0}


def test_the_index_agrees_with_all_records_and_counts_losses(tmp_path, monkeypatch):
    def lose(topic, number, row):
        return None if topic == "gearbox_state" and number in (7, 8, 20) else row

    def without_index(file):
        raise ValueError("no index")

    file = record(tmp_path / "bag", lose)
    by_index = read_info(file)
    (remark,) = by_index.remarks  # not of the end of a run before a reset
    assert remark.startswith(f"3 messages of {NAMESPACE}/gearbox_state are missing between")
    monkeypatch.setattr(Index, "of_summary", without_index)
    by_records = read_info(file)
    assert by_index.simulated == pytest.approx(by_records.simulated, rel=1e-12)
    by_index.simulated = by_records.simulated
    assert by_index == by_records


def test_the_command_lists_the_events(sound, tmp_path):
    file = tmp_path / "figures.json"
    answer = succeed("info", str(sound), "--events", "--json", file)
    figures = json.loads(file.read_text())
    events = [(event["run"], round(event["time"], 9), event["text"]) for event in figures["events"]]
    assert [event for event in events if "contact" not in event[2]] == [
        (1, 0.0, "start"),
        (1, 0.0, "tolerance = 0.001"),
        (1, 0.0, "waveform at 10000 Hz"),
        (1, 0.15, "tolerance = 0.01"),
        (1, 0.2, "waveform at 5000 Hz"),
        (2, 0.0, "start after a reset"),
        (2, 0.0, "tolerance = 0.001"),
        (2, 0.0, "waveform at 10000 Hz"),
    ]
    assert all(text in answer.output for _, _, text in events)
    assert figures["changes"][1]["values"] == {"backlash": 3e-7, "lambda_ratio": 1.5}
    state = figures["topics"][f"{NAMESPACE}/gearbox_state"]
    assert state["rate_hz"] == pytest.approx(40 / 1.09)
    assert state["longest_gap_s"] == pytest.approx(0.7099)


def test_contact_loss_and_missing_messages_are_reported(tmp_path):
    def alter(topic, number, row):
        if topic != "gearbox_state" or number not in (4, 5, 8):
            return {**row} if topic != "gearbox_state" else {**row, **_kept(row)}
        return None if number == 8 else {**row, **_kept(row), "sun_planet_contact_fraction": APART}

    file = record(tmp_path / "bag", alter)
    events = [(round(e.time, 9), e.text) for e in read_events(file, NAMESPACE, []) if e.run == 1]
    assert events[3:6] == [
        (0.03, "teeth separate in sun_planet_2"),
        (0.05, "teeth remain in contact in every mesh"),
        (0.08, "1 messages of gearbox_state are missing before"),
    ]


APART = np.array([1.0, 0.9, 1.0, *[np.nan] * 4])


def _kept(row):
    names = ("sun_planet_contact_fraction", "planet_ring_contact_fraction")
    return {name: np.where(np.isnan(row[name]), np.nan, 1.0) for name in names}


def ramped(folder, *legs):
    """A recording of ramps, as the node makes them: a step before each interval of 10 ms."""
    recording, twin = TwinRecording(folder), pt.Twin(pt.load_scene("paper"), 1000.0, 1e-3)
    recording.begin(twin, START_NS)
    for steps, values in legs:
        first = {name: getattr(twin.operating_point, name) for name in values}
        for n in range(1, steps + 1):
            twin.set(**{k: first[k] + (v - first[k]) * n / steps for k, v in values.items()})
            recording.point(twin)
            recording.advance(twin, 0.01)
        recording.advance(twin, 0.05)
    recording.finish()
    return recording.file


def listed_changes(file):
    printed = invoke("info", file).output.splitlines()
    lines = printed[[line.startswith("changes") for line in printed].index(True) :]
    return [line.removeprefix("changes").strip() for line in lines]


def test_a_ramp_is_one_line(tmp_path):
    legs = (50, {"input_torque": 30.0}), (20, {"backlash": 4e-7, "lambda_ratio": 2.0})
    file = ramped(tmp_path / "bag", *legs)
    start, *ways = listed_changes(file)
    assert start.startswith("0.0000 s  backlash = 2e-07 m")
    assert ways == [
        "0.0000 s  input_torque from 63 to 30 N m in 50 steps over 0.5 s",
        "0.5500 s  backlash from 2e-07 to 4e-07 m, lambda_ratio from 1 to 2 in 20 steps over 0.2 s",
    ]
    assert len(read_info(file).changes) == 1 + 50 + 20


def turned(*points, name="input_torque", namespace="/one"):
    return [Changed(time, namespace, {name: value}) for time, value in points]


def test_only_changes_at_a_constant_rate_are_one_ramp():
    """Reversals, pauses, restarts, and changes of other fields or gearboxes are separate."""
    begin = turned((0.0, 1.0))
    up = turned((1.0, 2.0), (1.01, 3.0), (1.02, 4.0))
    assert [len(ramp.times) for ramp in ramps(begin + up)] == [1, 3]
    for other in (
        turned((1.03, 3.0)),
        turned((1.05, 5.0)),
        turned((0.0, 5.0)),
        turned((1.03, 5.0), name="backlash"),
        turned((1.03, 5.0), namespace="/two"),
    ):
        assert [len(ramp.times) for ramp in ramps(begin + up + other)] == [1, 3, 1]
    by_hand = turned((1.0, 2.0), (3.0, 3.0), (5.0, 4.0))
    assert [len(ramp.times) for ramp in ramps(begin + by_hand)] == [1, 1, 1, 1]


def said(file):
    """Exit code of `info`, and its lines."""
    answer = invoke("info", file)
    assert not answer.exception or isinstance(answer.exception, SystemExit), answer.exception
    return answer.exit_code, answer.output.splitlines()


def test_a_finished_recording_of_nothing_ends_with_code_1(tmp_path):
    bag = BagWriter(tmp_path / "bag")
    bag.close()
    code, lines = said(bag.file)
    assert code == 1 and f"planetary-twin: {bag.file}: has no message that can be read" in lines


def with_its_origin_in_the_first_chunk(folder):
    """A finished recording of a run whose first chunk has no state."""
    recording = TwinRecording(folder)
    twin = pt.Twin(pt.load_scene("paper"), 10_000.0, 1e-3)
    recording.begin(twin, START_NS)
    for _ in range(3):
        recording.advance(twin, 0.01)
    recording.finish()
    return recording.file


@pytest.mark.parametrize("kind", ["flip", "cut out"])
def test_an_origin_lost_in_damage_is_said_to_be_lost(tmp_path, kind):
    file = with_its_origin_in_the_first_chunk(tmp_path / "bag")
    first = chunks(file)[0]
    data, place = bytearray(file.read_bytes()), first.chunk_start_offset + first.chunk_length // 2
    data[place] ^= 0xFF
    if kind == "cut out":
        del data[place]
    file.write_bytes(data)
    lost = (
        f"{file}: the origin of its run (run_origin) was lost in the damage, so its states cannot "
        "be verified"
    )
    code, lines = said(file)
    assert code == 0 and lines.count(f"planetary-twin: {lost}") == 1
    assert lost in recover(file, tmp_path / "saved").remarks
    answer = invoke("verify", file)
    assert answer.exit_code == 2 and answer.output == f"planetary-twin: {lost}\n"


def peak_of_info(folder):
    """Largest memory [bytes] that reading the contents of a recording takes."""
    tracemalloc.start()
    try:
        read_info(folder)
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


@pytest.mark.slow
def test_memory_does_not_grow_with_the_number_of_messages(tmp_path, monkeypatch):
    """An index of all messages would take at least 16 bytes for each of 260 000 more."""
    monkeypatch.setattr("planetary_twin_py.recording.container.integrity._PIECE", 2**16)
    peaks = []
    for count in (40_000, 40_000, 300_000):  # the first one also loads modules
        numbered = Numbered(tmp_path / f"bag_{len(peaks)}")
        numbered.write(count)
        numbered.bag.close()
        assert read_info(numbered.bag.folder).topics["/numbers"].recorded == count
        peaks.append(peak_of_info(numbered.bag.folder))
    assert peaks[2] < peaks[1] + 1_000_000


@pytest.mark.parametrize(
    ("altered", "missing", "doubled"),
    [({}, 0, 0), ({4: ()}, 1, 0), ({2: (), 3: ()}, 2, 0), ({5: (5, 5)}, 0, 1)],
)
def test_sensors_are_listed_with_their_blocks(tmp_path, altered, missing, doubled):
    file = record_twin(tmp_path / "bag", lambda n: altered.get(n, (n,)), duration=0.08)
    (sensor,) = read_info(file).sampled.values()
    assert sensor == SampledInfo(RATE, {"ring_top": "m/s^2"}, missing, doubled)
    text = invoke("info", file).output
    assert "ring_top: ring_top [m/s^2] at 25600 Hz" in text
    shown = bool(re.search("block.* missing", text)), "recorded twice" in text
    assert shown == (bool(missing), bool(doubled))


def test_every_block_is_looked_at_with_the_events(tmp_path):
    altered = {4: (), 5: (5, 5)}  # as many numbers as blocks
    file = record_twin(tmp_path / "bag", lambda n: altered.get(n, (n,)), duration=0.08)
    done = invoke("info", file, "--events", "--json", "-")
    (sensor,) = json.loads(done.stdout)["sensors"].values()
    assert (sensor["missing_blocks"], sensor["doubled_blocks"]) == (1, 1)
