"""Temperatures in recordings: verified bit for bit, and simulated again in another place."""

from command_line import run_here

from planetary_twin_py import load_scene

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
    verified = run_here("verify", file)
    assert verified.returncode == 0
    assert "1 oil_temperature, 1 thermal_state" in " ".join(verified.stdout.split())
    assert "identical bit for bit" in verified.stdout
    changed = run_here("resimulate", file, "--set", "ambient_temperature=270K", "--out", again)
    assert changed.returncode == 0
    tables = []
    for name, recording in (("before", file), ("after", again)):
        table = tmp_path / f"{name}.csv"
        assert run_here("export", recording, "--topics", "thermal_state", "--out", table)
        heading, row = table.read_text().splitlines()
        tables.append(dict(zip(heading.replace('"', "").split(","), row.split(","), strict=True)))
    before, after = tables
    assert float(after["ambient"]) == 270.0
    assert float(after["housing"]) < float(before["housing"])
