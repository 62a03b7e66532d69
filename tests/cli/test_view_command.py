"""The command `view` as typed."""

import pytest
from command_line import run_here, succeed
from twin_recording import write_recording


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    return write_recording(tmp_path_factory.mktemp("bag") / "one.mcap", 0.1)


def test_save_needs_no_display(file, tmp_path, monkeypatch):
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    succeed("view", file, "--scene", "paper", "--save", tmp_path / "a.rrd")
    assert (tmp_path / "a.rrd").stat().st_size > 1e5


def test_without_a_display_one_line_names_the_alternatives(file, monkeypatch):
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    done = run_here("view", file, "--scene", "paper")
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
    assert "--save" in done.stderr
    assert "--screenshot" in done.stderr


def test_a_long_recording_is_shown_in_part(tmp_path, monkeypatch):
    monkeypatch.setattr("planetary_twin_py.view.session.MOST_STATES", 20)
    long = write_recording(tmp_path / "long.mcap", 0.5)
    arguments = "view", long, "--scene", "paper", "--save"
    answer = succeed(*arguments, tmp_path / "a.rrd")
    assert "more than 20 states: only those from 0.01 to" in answer.stderr
    options = "--during", "0.3:0.4"
    answer = succeed(*arguments, tmp_path / "b.rrd", *options)
    assert "more than" not in answer.stderr
