"""Completions in a shell, and the time they take."""

import subprocess
import sys
from pathlib import Path

import pytest
from command_line import run

from planetary_twin_py import packaged_scenes
from planetary_twin_py.terminal.arguments import (
    complete_recording,
    complete_scene,
)

HEAVY = ("planetary_twin_py._core", "numpy", "pint", "rclpy", "rich", "scipy")


@pytest.fixture
def recordings(tmp_path, monkeypatch):
    """Recordings in their folder, one elsewhere, and a file that is none."""
    monkeypatch.chdir(tmp_path)
    for name in ("recordings/first", "recordings/second", "other/third"):
        (tmp_path / name).mkdir(parents=True)
        (tmp_path / name / "part_0.mcap").touch()
    (tmp_path / "recordings/notes").mkdir()
    (tmp_path / "recordings/README.md").touch()
    (tmp_path / "loose.mcap").touch()


def offered(*words):
    """The completions that bash receives for the last of these words."""
    line = ("planetary-twin", *words)
    answer = run(
        _PLANETARY_TWIN_COMPLETE="complete_bash",
        COMP_WORDS=" ".join(line),
        COMP_CWORD=str(len(line) - 1),
        prelude="import sys; sys.argv[0] = 'planetary-twin'",
    )
    assert answer.returncode == 0 and not answer.stderr, answer.stderr
    return answer.stdout.split()


def test_scenes_are_those_that_can_be_loaded():
    assert complete_scene("") == list(packaged_scenes())
    assert complete_scene("pap") == ["paper", "paper_printed"]
    assert complete_scene("./my.yaml") == []


def test_recordings_are_files_and_folders_of_files(recordings):
    assert complete_recording("") == ["loose.mcap", "recordings/first", "recordings/second"]
    assert complete_recording("recordings/s") == ["recordings/second"]
    assert complete_recording("other/") == ["other/third"]
    assert complete_recording("nowhere/x") == []


def test_a_shell_is_offered_commands_scenes_and_recordings(recordings):
    assert offered("sim") == ["simulate"]
    assert offered("explain", "crack") == ["cracked_tooth"]
    assert offered("replay", "recordings/f") == ["recordings/first"]
    assert offered("view", "--scene", "wind") == ["wind_turbine_stage"]


def test_completion_and_help_import_no_slow_module():
    for words in (["--help"], ["simulate", "--help"], ["run", "--help"]):
        code = (
            "import atexit, sys\n"
            f"atexit.register(lambda: print(*[m for m in {HEAVY} if m in sys.modules], "
            "file=sys.stderr))\n"
            "from planetary_twin_py.cli import main; main()"
        )
        done = subprocess.run(
            [sys.executable, "-c", code, *words], capture_output=True, text=True, check=True
        )
        assert done.stderr.strip() == ""


def test_bash_completes_with_the_printed_script():
    """The script is for the shell that requests it."""
    program = Path(sys.executable).with_name("planetary-twin")
    done = subprocess.run(
        ["bash", "-c", f'eval "$({program} --show-completion)"; complete -p planetary-twin'],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0 and done.stdout.startswith("complete "), done.stderr


def test_fields_of_a_scene_complete_settings_and_sweeps():
    assert offered("simulate", "--set", "backl") == ["backlash="]
    assert offered("sweep", "paper", "--inp") == ["--input-speed", "--input-torque"]
    assert offered("sweep", "paper", "--mesh.damping.lo") == [
        "--mesh.damping.loss_factor",
        "--mesh.damping.lowest_frequency",
    ]
    assert "--samples" in offered("sweep", "paper", "--sa")
