"""Temperatures in recordings: verified bit for bit, and simulated again in another place."""

import numpy as np
import pytest
from command_line import run_here, succeed

from planetary_twin_py import Twin, load_scene
from planetary_twin_py.recording.runs.info import read_info
from planetary_twin_py.recording.runs.offline import Plan, record
from planetary_twin_py.recording.runs.slow_states import read_thermal

SCENE = """
base: paper
dynamics: quasi_static
lubrication: {lambda_ratio: computed}
thermal:
  ambient: 25 degC
  oil: {mass: 0.5 kg}
  gears: {to_oil: 2000 W/(m^2 K)}
  housing: {mass: 4 kg, area: 0.1 m^2, height: 0.2 m, from_oil: 10 W/K}
  start: steady
"""


def test_recorded_temperatures_are_verified_and_follow_other_air(tmp_path):
    scene, file, again = tmp_path / "warm.yaml", tmp_path / "run.mcap", tmp_path / "again"
    scene.write_text(SCENE)
    assert load_scene(scene).thermal.start == "steady"
    arguments = ("--duration", "1.1", "--sample-rate", "1000", "--out", file)
    assert run_here("simulate", scene, *arguments).returncode == 0
    verified = succeed("verify", file)
    assert "1 oil_temperature, 1 thermal_state" in " ".join(verified.stdout.split())
    assert "identical bit for bit" in verified.stdout
    succeed("resimulate", file, "--set", "ambient_temperature=270K", "--out", again)
    tables = []
    for name, recording in (("before", file), ("after", again)):
        table = tmp_path / f"{name}.csv"
        assert run_here("export", recording, "--topics", "thermal_state", "--out", table)
        heading, row = table.read_text().splitlines()
        tables.append(dict(zip(heading.replace('"', "").split(","), row.split(","), strict=True)))
    before, after = tables
    assert float(after["ambient"]) == 270.0
    assert float(after["housing"]) < float(before["housing"])


def test_the_operating_point_has_the_present_temperature_of_the_oil(tmp_path):
    scene = load_scene("paper").replace(
        dynamics="quasi_static",
        thermal={
            "ambient": 298.15,
            "oil": {"mass": 0.01},
            "gears": {"to_oil": 2000.0, "sun_mass": 0.02, "ring_mass": 0.02},
            "housing": {"mass": 0.4, "area": 0.1, "height": 0.2, "from_oil": 10.0},
        },
    )
    first = record(Plan(scene, 1.0, 1000.0, 1e-3), tmp_path / "run.mcap")
    assert read_info(first).changes[0].values["oil_temperature"] == 298.15
    arguments = ("--set", "input_torque=40", "--from", "0.5", "--out", tmp_path / "branch")
    assert run_here("resimulate", first, *arguments).returncode == 0
    branch = tmp_path / "branch"
    later = read_info(branch).changes[1].values
    twin = Twin(scene, 1000.0, 1e-3)
    for _ in range(50):
        twin.advance(0.01)
    assert later["oil_temperature"] == twin.operating_point.oil_temperature > 298.16
    assert later["input_torque"] == 40.0
    verified = run_here("verify", branch)
    assert (verified.returncode, "identical bit for bit" in verified.stdout) == (0, True)


def test_extremes_of_a_second_are_those_of_its_windows_and_gain_of_all(tmp_path):
    rated = {"bearings": {"planet": {"rating": 5e3, "kind": "roller"}}}
    path = tmp_path / "warm.yaml"
    path.write_text(SCENE.replace("steady", "ambient"))
    scene = load_scene(path).replace(durability=rated)
    twin, expected = Twin(scene, 1000.0, 1e-3), []
    for _ in range(100):
        expected.append(twin.advance(0.01).damage.peaks)
    file = record(Plan(scene, 1.0, 1000.0, 1e-3), tmp_path / "run.mcap")
    place = file, "/planetary_twin", frozenset(["/planetary_twin/thermal_state"])
    _, hottest, thinnest = read_thermal(*place)
    assert hottest.names == thinnest.names == twin.meshes
    highest = np.max([peaks["contact_temperature"] for peaks in expected], axis=0)
    assert hottest.values[0] == pytest.approx(highest, rel=1e-9)
    smallest = np.min([peaks["specific_film"] for peaks in expected], axis=0)
    assert thinnest.values[0] == pytest.approx(smallest, rel=1e-9)
    (last,) = read_info(file).temperatures.values()
    assert last.contact == highest.max()
    assert last.film == smallest.min()
    assert last.parts["sun"] == twin.temperatures["sun"]
    assert "identical bit for bit" in run_here("verify", file).stdout
    shown = " ".join(run_here("info", file).stdout.split())
    assert f"feedback gain {last.gain:.3g}; contact temperature up to" in shown
