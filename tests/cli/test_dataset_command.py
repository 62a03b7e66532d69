"""The command `dataset` as typed."""

import json
from functools import partial

import command_line
import pytest
from datasets.small import SPEC

run = partial(command_line.invoke, "dataset")
succeed = partial(command_line.succeed, "dataset")


@pytest.fixture
def spec(tmp_path):
    path = tmp_path / "spec.yaml"
    path.write_text(SPEC)
    return path


def test_a_data_set_is_written_and_counted(spec, tmp_path):
    out, found = tmp_path / "set", tmp_path / "set.json"
    done = succeed(spec, "--out", out, "--workers", 2, "--json", found)
    assert f"{out}: 15 records: 5 healthy, 5 sun_crack, 5 worn+cracked" in done.stdout
    assert "specimens: 3 train, 1 validation, 1 test" in done.stdout
    figures = json.loads(found.read_text())
    assert figures["labels"] == {"healthy": 5, "sun_crack": 5, "worn+cracked": 5}
    assert figures["records"] == figures["signals"] == 15
    again = run(spec, "--out", out)
    assert again.exit_code == 2 and "already exists; choose another name" in again.stderr


@pytest.mark.parametrize(
    ("given", "wrong", "said"),
    [
        ("specimens: 5", "specimens: 0", "specimens = 0"),
        ("tooth: 0:29", "tooth: 0:99", "faults.0.tooth = 99: must be at most 29"),
        ("normal(0 um,2 um)", "normal(0 um,2 m)", "specimen 0: errors: pin_tangential = "),
        ("duration: 0.05 s", "duration: 1 ns", "gives 0 samples of sensor ring: must be within 1"),
    ],
)
def test_a_wrong_specification_ends_in_one_line(given, wrong, said, spec, tmp_path):
    spec.write_text(SPEC.replace(given, wrong, 1))
    done = run(spec, "--out", tmp_path / "set")
    assert done.exit_code == 2 and done.stderr.count("\n") == 1
    assert done.stderr.startswith(f"planetary-twin: {spec}: ") and said in done.stderr
    assert not (tmp_path / "set").exists()


def test_a_scene_without_sensors_is_refused(spec, tmp_path):
    lines = SPEC.splitlines()
    text = "\n".join(line for line in lines if "sensors" not in line and line != "set:")
    spec.write_text(text)
    done = run(spec, "--out", tmp_path / "set")
    assert done.exit_code == 2 and "sensors: none with samples" in done.stderr


def test_a_missing_file_and_no_workers_are_refused(spec, tmp_path):
    done = run(tmp_path / "no.yaml", "--out", tmp_path / "set")
    assert done.exit_code == 2 and "no.yaml: No such file" in done.stderr
    done = run(spec, "--out", tmp_path / "set", "--workers", 0)
    assert done.exit_code == 2 and "--workers = 0: must be at least 1" in done.stderr


def test_a_record_that_cannot_be_simulated_ends_the_command(spec, tmp_path):
    wander = SPEC.replace("speed_wander: 0.01", "speed_wander: 0.2, speed_ramp: 1")
    spec.write_text(wander.replace("set:", "set:\n  drive.speed_limit: 1101 rpm"))
    done = run(spec, "--out", tmp_path / "set", "--workers", 1)
    assert done.exit_code == 2 and "specimen00000_run0000: input_speed = " in done.stderr
    assert "drive.speed_limit" in done.stderr
