"""A recording tells what it holds, what it lacks, and what was changed when."""

import json

import pytest
from twin_recording import NAMESPACE, record
from typer.testing import CliRunner

from planetary_twin_py.cli import build_app
from planetary_twin_py.recording.info import read_info


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
