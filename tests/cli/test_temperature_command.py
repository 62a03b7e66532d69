"""The command `temperature`, and what `simulate` prints of temperatures."""

import json

import pytest
from command_line import invoke
from recording.runs.test_temperatures import SCENE


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "warm.yaml"
    path.write_text(SCENE)
    return path


def test_the_states_are_printed_and_written(scene, tmp_path):
    out = tmp_path / "states.json"
    found = invoke("temperature", scene, "--input-torque", "20 N m,60 N m", "--json", out)
    assert "feedback gain" in found.stdout
    weak, strong = json.loads(out.read_text())["states"]
    assert 298.15 < weak["oil_K"] < strong["oil_K"] < strong["sun_K"]
    assert weak["stable"] == strong["stable"] == "yes"


def test_a_scene_without_the_section_is_refused_in_one_line():
    found = invoke("temperature", "paper")
    assert found.exit_code != 0
    assert "thermal: missing" in found.stderr


def test_simulate_prints_temperatures_and_heat(scene, tmp_path):
    out = tmp_path / "run.json"
    found = invoke("simulate", scene, "--duration", "0.3", "--json", out)
    assert "oil at the end" in found.stdout
    figures = json.loads(out.read_text())
    assert figures["temperatures"]["sun_K"] > figures["temperatures"]["ambient_K"]
    assert sum(figures["heat"].values()) == pytest.approx(figures["mean_power_loss_W"], rel=1e-9)
