"""An altered recording is detected; an unaltered one is identical bit for bit."""

import json
from dataclasses import replace

import numpy as np
import pytest
from command_line import invoke
from tiers import first_rows
from twin_recording import NAMESPACE, record, without

from planetary_twin_py.recording.container.integrity import end_of_data
from planetary_twin_py.recording.container.records import RecordingError
from planetary_twin_py.recording.runs.comparison import BOUND
from planetary_twin_py.recording.runs.origin import makers_here
from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.recording.runs.verify import verify


def altering(topic, number, field, change):
    """Change one field of one message."""

    def alter(at, count, row):
        if (at, count) == (topic, number):
            row = {**row, field: change(row[field])}
        return row

    return alter


def next_bit(value):
    """The next representable number, in the third element of an array."""
    if isinstance(value, np.ndarray):
        changed = value.copy()
        changed[2] = np.nextafter(value[2], np.array(np.inf, value.dtype))
        return changed
    return float(np.nextafter(value, np.inf))


def test_an_unaltered_recording_is_identical_bit_for_bit(sound):
    verdict = verify(sound, NAMESPACE)
    assert verdict.identical and verdict.same_makers
    assert verdict.remarks == []
    assert verdict.messages == {"gearbox_state": 41, "joint_states": 41, "mesh_waveform": 40}
    assert verdict.values > 6 * 3 * (20 * 100 + 10 * 50 + 10 * 100)
    assert verdict.largest == 0.0


@pytest.mark.parametrize(
    ("topic", "field", "change", "place"),
    first_rows(
        2,
        [
            ("gearbox_state", "power_loss", next_bit, 0),
            ("mesh_waveform", "friction", next_bit, 2),
            ("gearbox_state", "sun_planet_dte_rms", next_bit, 2),
            ("gearbox_state", "planets", lambda planets: planets + 1, 0),
            ("mesh_waveform", "sample_period", next_bit, 0),
            ("joint_states", "position", next_bit, 2),
        ],
    ),
)
def test_one_altered_bit_is_found_where_it_is(tmp_path, topic, field, change, place):
    file = record(tmp_path / "altered", altering(topic, 25, field, change))
    verdict = verify(file, NAMESPACE)
    assert not verdict.identical
    first = verdict.first_difference
    assert (first.topic, first.field, first.place) == (topic, field, place)
    assert first.time == pytest.approx(0.25)
    assert first.recorded != first.simulated


@pytest.mark.parametrize(
    ("topic", "number", "field", "change"),
    [
        ("operating_point", 2, "backlash", lambda play: play * (1.0 + 1e-9)),
        ("gearbox_state", 12, "tolerance", next_bit),
        ("run_origin", 1, "data", lambda text: text.replace("torque: 63.0", "torque: 64.0")),
    ],
)
def test_an_altered_input_shows_in_what_depends_on_it(tmp_path, topic, number, field, change):
    verdict = verify(record(tmp_path / "a", altering(topic, number, field, change)), NAMESPACE)
    assert not verdict.identical
    assert verdict.first_difference is not None


def test_a_block_at_an_impossible_time_is_reported(tmp_path):
    file = record(tmp_path / "a", altering("mesh_waveform", 25, "start_time", next_bit))
    assert verify(file, NAMESPACE).remarks == [
        "1 messages of mesh_waveform belong to no interval that is simulated again"
    ]


def test_missing_messages_are_bridged_while_nothing_changes(tmp_path):
    verdict = verify(record(tmp_path / "a", without("gearbox_state", {5, 6})), NAMESPACE)
    assert verdict.first_difference is None
    assert verdict.messages["gearbox_state"] == 39
    assert verdict.not_recorded == 2
    assert [remark.split()[0] for remark in verdict.remarks] == ["2", "2"]  # joints, waveform


def test_settings_that_change_within_a_gap_are_not_inferred(tmp_path):
    """Interval 16 is the first at another tolerance."""
    verdict = verify(record(tmp_path / "a", without("gearbox_state", {14, 15, 16, 17})), NAMESPACE)
    assert verdict.first_difference is None
    assert "4 messages of gearbox_state are missing before 0.13 s" in verdict.remarks[0]


def test_messages_after_a_lost_change_are_not_compared(tmp_path):
    lost_change = without("operating_point", {2})
    verdict = verify(record(tmp_path / "a", lost_change), NAMESPACE)
    assert "1 messages of operating_point are missing" in verdict.remarks[0]
    assert verdict.first_difference is None
    assert verdict.messages["gearbox_state"] == 10  # of the run after the reset


@pytest.mark.parametrize(
    "left_out", [without("run_origin", {1, 2}), without("gearbox_state", {1, 32})]
)
def test_without_a_start_nothing_can_be_simulated_again(tmp_path, left_out):
    with pytest.raises(RecordingError, match="has no run with its start"):
        verify(record(tmp_path / "a", left_out), NAMESPACE)


def test_all_messages_of_an_unfinished_file_are_compared(sound, tmp_path):
    truncated = tmp_path / "truncated.mcap"
    truncated.write_bytes(sound.read_bytes()[: end_of_data(sound)])
    code, output = printed(truncated)
    assert code == 1
    assert (
        "truncated.mcap: has no end record: the recorder is still writing, or was killed" in output
    )
    assert "122 messages read, all identical bit for bit" in output


def test_messages_written_during_the_comparison_are_left(sound, tmp_path):
    whole, path = sound.read_bytes(), tmp_path / "growing.mcap"
    path.write_bytes(whole[: len(whole) * 2 // 3])

    def write_the_rest(time):
        path.write_bytes(whole)

    result = verify(path, NAMESPACE, write_the_rest)
    assert result.left_out == 0
    assert result.first_difference is None
    assert all("belong to no interval" not in remark for remark in result.remarks)


def printed(*arguments):
    answer = invoke("verify", *arguments)
    return answer.exit_code, answer.output


def test_other_machines_may_differ_within_the_bound(tmp_path):
    foreign = replace(makers_here(), machine="another")
    within = "within the bound between machines"
    beyond = "differs by more than the bound between machines"
    for share, code, result in ((0.1, 0, within), (10.0, 1, beyond)):
        shift = share * BOUND * 1e-3  # times the tolerance
        alter = altering("gearbox_state", 5, "power_loss", lambda loss, by=shift: loss * (1 + by))
        file = record(tmp_path / str(code), alter, foreign)
        verdict = verify(file, NAMESPACE)
        assert not verdict.same_makers and not verdict.identical
        assert verdict.largest == pytest.approx(share * BOUND, rel=0.2)
        found, output = printed(file)
        assert found == code
        assert output.splitlines()[-1] == f"result            {result}"


def test_stored_power_is_compared_with_the_input_power(tmp_path, sound):
    state = read_recording(sound).state
    power, stored = state["input_power"][4], state["stored_power"][4]
    assert 0.0 < abs(stored) < 0.2 * power
    shift = 0.1 * BOUND * 1e-3 * power
    alter = altering("gearbox_state", 5, "stored_power", lambda value: value + shift)
    verdict = verify(record(tmp_path / "bag", alter), NAMESPACE)
    assert verdict.largest == pytest.approx(0.1 * BOUND, rel=0.01)


def test_the_command_prints_its_findings(sound, tmp_path):
    code, output = printed(sound, "--json", tmp_path / "figures.json")
    assert code == 0, output
    assert "identical bit for bit" in output
    figures = json.loads((tmp_path / "figures.json").read_text())
    assert figures["identical"] is True and figures["first_difference"] is None

    file = record(tmp_path / "a", altering("gearbox_state", 25, "power_loss", next_bit))
    code, output = printed(file, "--json", tmp_path / "figures.json")
    assert code == 1
    assert "gearbox_state.power_loss[0] at 0.25 s" in output
    assert "result            differs, although the same core" in output
    assert json.loads((tmp_path / "figures.json").read_text())["first_difference"]["time"] == 0.25


@pytest.mark.parametrize("last", [40, 39])
def test_a_recorder_may_stop_within_an_interval(tmp_path, last):
    """States end one or two intervals before the other topics."""
    states = range(last, 42)
    verdict = verify(record(tmp_path / "bag", without("gearbox_state", states)), NAMESPACE)
    assert verdict.identical and verdict.left_out == 0
    assert verdict.messages["gearbox_state"] == 41 - len(states)
    assert verdict.messages["joint_states"] == verdict.messages["gearbox_state"]
