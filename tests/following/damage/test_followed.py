"""`follow` continues the damage of a gearbox: in Python and by the command."""

import contextlib
import json

import numpy as np
import pytest
from command_line import run_here

import planetary_twin_py as pt
from planetary_twin_py.durability.state_file import read_state
from planetary_twin_py.durability.state_text import state_text
from planetary_twin_py.following.damage import followed as followed_damage
from planetary_twin_py.following.follower import Follower
from planetary_twin_py.following.input_error import InputError
from planetary_twin_py.following.readings import Readings

from ..power_map import PARTS, SCENE, PowerMap, expected_rates

COUNT, SPEED, RATIO = 600, 104.72, -3.0 / 7.0
SET = [
    *("--set", "durability.bearings.planet.rating=20 kN"),
    *("--set", "durability.bearings.planet.kind=roller"),
]


@pytest.fixture
def powers(monkeypatch):
    """The map of the followers is one in closed form."""
    monkeypatch.setattr(followed_damage, "measured_map", lambda scene: PowerMap())


def readings(first=0, last=COUNT, **changes):
    chance = np.random.default_rng(0)
    noise = chance.standard_normal((2, COUNT))
    torque = 60.0 + 3.0 * np.sin(np.arange(COUNT) / 30.0)
    columns = {
        "input_torque": torque + 0.1 * noise[0],
        "output_torque": -(torque - 0.8) / RATIO + 0.2 * noise[1],
        "input_speed": np.full(COUNT, SPEED),
        "oil_temperature": np.full(COUNT, 343.15),
    } | changes
    rows = slice(first, last)
    return Readings(0.1 * np.arange(COUNT)[rows], {n: v[rows] for n, v in columns.items()})


def test_a_follower_counts_saves_and_goes_on(powers, tmp_path):
    path = tmp_path / "state.json"
    whole = Follower(SCENE, durability=tmp_path / "whole.json")
    whole.add(readings())
    for first in (0, 150, 300, 450):
        follower = Follower(SCENE, durability=path)
        follower.add(readings(first, first + 150))
        follower.finish()
        follower.save_damage()
    torque = readings().columns["input_torque"]
    expected = (expected_rates(torque, SPEED)[1:] * 0.1).sum(axis=0)
    assert whole.damage.state.sums == pytest.approx(expected, rel=1e-9)
    assert path.read_text() == state_text(whole.damage.state, SCENE)


def test_readings_that_contradict_the_scene_are_not_saved(powers, tmp_path):
    path = tmp_path / "state.json"
    follower = Follower(SCENE, durability=path)
    with pytest.raises(InputError):
        follower.add(readings(output_torque=readings().columns["output_torque"] * 12.0))
        follower.finish()
    assert not path.exists()


def test_a_factor_on_torques_is_one_on_their_scatter(powers, tmp_path):
    plain = Follower(SCENE, durability=tmp_path / "plain.json")
    scaled = Follower(SCENE, scale={"input_torque": -2.0}, durability=tmp_path / "scaled.json")
    block = readings()
    plain.add(block._replace(torque_sd=np.full(COUNT, 5.0)))
    half = {**block.columns, "input_torque": -0.5 * block.columns["input_torque"]}
    scaled.add(block._replace(columns=half, torque_sd=np.full(COUNT, 2.5)))
    assert scaled.damage.state.sums.tolist() == plain.damage.state.sums.tolist()


def test_without_a_file_there_is_no_damage_to_save():
    follower = Follower(pt.load_scene("paper"))
    for refused in (follower.save_damage, lambda: follower.replace_part("sun")):
        with pytest.raises(ValueError, match="durability = None: must be the path of a file"):
            refused()


def table(path, first, last):
    block = readings(first, last)
    headings = ["time", *block.columns]
    rows = np.column_stack([block.time, *block.columns.values()])
    np.savetxt(path, rows, delimiter=",", header=",".join(headings), comments="", fmt="%.9g")


def follow(*arguments, cwd):
    with contextlib.chdir(cwd):
        return run_here("follow", "paper", *SET, *arguments)


def test_the_command_continues_replaces_and_refuses(tmp_path):
    table(tmp_path / "first.csv", 0, 300)
    table(tmp_path / "second.csv", 300, 600)
    table(tmp_path / "both.csv", 0, 600)
    state = ("--durability", "state.json")
    first = follow("--from", "first.csv", *state, cwd=tmp_path)
    assert first.returncode == 0, first.stderr
    assert "damage of" in first.stdout and "planet_1_bearing" in first.stdout
    second = follow("--from", "second.csv", *state, "--json", "out.json", cwd=tmp_path)
    assert second.returncode == 0, second.stderr
    figures = json.loads((tmp_path / "out.json").read_text())["damage"]
    assert figures["hours"] * 3600.0 == pytest.approx(59.9)
    assert follow("--from", "both.csv", "--durability", "whole.json", cwd=tmp_path).returncode == 0
    assert (tmp_path / "state.json").read_text() == (tmp_path / "whole.json").read_text()
    again = follow("--from", "both.csv", *state, cwd=tmp_path)
    assert "600 readings are not later" in " ".join(again.stderr.split())
    assert (tmp_path / "state.json").read_text() == (tmp_path / "whole.json").read_text()
    new = follow("--from", "both.csv", *state, "--replace", "planet_2_bearing", cwd=tmp_path)
    assert "planet_2_bearing replaced after" in " ".join(new.stdout.split())
    replaced = read_state(tmp_path / "state.json", SCENE, PARTS)
    assert replaced.sums[PARTS.index("planet_2_bearing")] == 0.0
    before = (tmp_path / "state.json").read_bytes()
    for wrong in (("--set", "gearset.face_width=0.021"), ("--replace", "moon")):
        refused = follow("--from", "both.csv", *state, *wrong, cwd=tmp_path)
        assert refused.returncode == 2 and len(refused.stderr.strip().splitlines()) <= 3
        assert (tmp_path / "state.json").read_bytes() == before
