"""A command that cannot write refuses before it computes."""

import os

import pytest
from command_line import invoke

LONG = ("--duration", "3000")  # [s] longer than anyone would wait
COMMANDS = [
    ("simulate", "paper", *LONG, "--out", "{}/run.npz"),
    ("simulate", "paper", *LONG, "--out", "{}/run.mcap"),
    ("simulate", "paper", *LONG, "--json", "{}/run.json"),
    ("explain", "paper", *LONG, "--json", "{}/run.json"),
    ("sweep", "paper", "--input-speed", "100:200:50", *LONG, "--out", "{}/s.csv"),
    ("stribeck", "paper", "--out", "{}/s.csv"),
    ("bifurcation", "paper", "--settling", "1000", "--out", "{}/s.png"),
    ("plot", "s.csv", "--out", "{}/s.png"),
    ("modal", "--campbell", "{}/c.png"),
    ("modal", "--json", "{}/c.json"),
    ("bench", "--json", "{}/c.json"),
    ("bench", "--plot", "{}/c.png"),
    ("bench", "--markdown", "{}/c.md"),
    ("fields", "--json", "{}/c.json"),
    ("info", "recordings/none", "--json", "{}/c.json"),
    ("verify", "recordings/none", "--json", "{}/c.json"),
    ("fit", "recordings/none", "--free", "backlash", "--json", "{}/c.json"),
    ("spectrum", "recordings/none", "--out", "{}/c.csv"),
    ("view", "recordings/none", "--save", "{}/c.rrd"),
    ("view", "recordings/none", "--screenshot", "{}/c.png"),
    ("import", "rig.csv", "--out", "{}/c.mcap"),
]
ENDINGS = [
    ("follow", "paper", "--from", "rig.csv", "--out", "a.txt"),
    ("fleet", "paper", "--from", "rig.csv", "--out", "a.txt"),
    ("fit", "rig.csv", "--free", "backlash", "--scene", "paper", "--report", "a.txt"),
    ("plant", "paper", "--duration", "1e6", "--out", "a.txt"),
    ("plant", "paper", "--duration", "1e6", "--out", "a.csv", "--encoders", "a.txt"),
    ("lost-motion", "paper", "--picture", "a.txt"),
    ("load-sharing", "paper", "--picture", "a.txt"),
    ("export-fmu", "paper", "--out", "a.txt"),
]


@pytest.mark.parametrize("command", ENDINGS, ids=" ".join)
def test_a_file_name_with_another_ending_is_refused_at_once(command, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    done = invoke(*command)
    assert done.exit_code == 2
    assert "= 'a.txt': must end in ." in done.stderr and done.stderr.count("\n") == 1


@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_a_folder_that_does_not_exist_is_refused_at_once(command, tmp_path):
    missing = tmp_path / "missing"
    done = invoke(*(part.format(missing) for part in command))
    assert done.exit_code == 2
    assert f"the folder {missing} does not exist" in done.stderr
    assert done.stderr.count("\n") == 1
    assert not missing.exists()


@pytest.mark.parametrize(
    ("out", "reason"),
    [("taken", "already exists; choose another name"), ("plain/run", "plain is not a folder")],
)
def test_a_recording_that_cannot_be_created_is_refused_at_once(out, reason, tmp_path):
    (tmp_path / "taken").mkdir()
    (tmp_path / "plain").write_text("")
    arguments = ["simulate", "paper", *LONG, "--out", str(tmp_path / out)]
    done = invoke(*arguments)
    assert done.exit_code == 2
    assert reason in done.stderr and done.stderr.count("\n") == 1


def test_a_folder_in_the_place_of_a_file_is_refused_at_once(tmp_path):
    done = invoke("modal", "--json", tmp_path)
    assert done.exit_code == 2
    assert "is a folder; name a file" in done.stderr


def test_a_pipe_in_the_place_of_a_table_is_refused_at_once(tmp_path):
    os.mkfifo(pipe := tmp_path / "pipe.csv")
    done = invoke("plant", "paper", "--out", pipe)
    assert done.exit_code == 2
    assert "pipe.csv': must be a file" in done.stderr


def test_parents_of_the_folder_of_a_recording_are_created(tmp_path):
    out = tmp_path / "new" / "run"
    done = invoke("simulate", "paper", "--duration", 0.01, "--out", out)
    assert done.exit_code == 0, done.output
    assert list(out.glob("*.mcap"))
