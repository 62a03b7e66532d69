"""What the command `simulate` says about damage."""

import json
from dataclasses import replace
from functools import partial
from pathlib import Path

import command_line
import pytest

import planetary_twin_py as pt

invoke = partial(command_line.invoke, "simulate")
PACKAGED = Path(pt.__file__).parent / "scene" / "packaged" / "reference_gearbox_stage.yaml"
SECTION = """
durability:
  face_load_factor: {factor}
  scuffing: {{temperature: {hot} degC}}
  micropitting: {{permissible_film: {film}}}
  bearings: {{planet: {{rating: 5500 kN, number: 2, kind: roller}}}}
"""


@pytest.fixture
def scene(tmp_path):
    def write(factor=1.15, film=0.1, hot=400):
        path = tmp_path / "scene.yaml"
        path.write_text(PACKAGED.read_text() + SECTION.format(factor=factor, film=film, hot=hot))
        return path

    return write


def test_damage_by_part_is_that_of_the_library(scene):
    path = scene()
    done = invoke(path, "--duration", "1", "--json", "-")
    found = json.loads(done.stdout)["damage"]
    damage = pt.simulate(pt.load_scene(path), 1.0).damage
    hourly = dict(zip(damage.parts, (3600.0 * damage.rate).tolist(), strict=True))
    assert found["per_hour"] == pytest.approx(hourly)
    worst = max(hourly, key=hourly.get)
    assert found["shortest_lived"] == worst
    assert found["hours_to_damage_1"] == pytest.approx(1.0 / hourly[worst])
    hottest = damage.peaks["contact_temperature"].max()
    assert found["scuffing_margin"] == pytest.approx((400.0 - 65.0) / (hottest - 273.15 - 65.0))
    shown = invoke(path, "--duration", "1").stdout
    assert worst in shown and "no rating" in shown
    assert "contact temperature (Blok)" in shown and "specific film, smallest" in shown


def test_what_the_damage_leaves_out_is_remarked(scene):
    def remarks(**given):
        done = invoke(scene(**given), "--duration", "0.5", "--json", "-")
        return json.loads(done.stdout)["remarks"]

    plain = remarks()
    assert any("the root of the ring is not counted" in line for line in plain)
    assert not any("face_load_factor" in line for line in plain)
    assert any(line.startswith("durability.face_load_factor = 1:") for line in remarks(factor=1))
    assert any("micropits are expected" in line for line in remarks(film=3.0))
    assert any("scuffing temperature" in line for line in remarks(hot=80))
    weak = pt.load_scene(scene()).replace(**{"durability.material.sun.flank": 3e8})
    run = pt.simulate(weak, 0.5)
    from planetary_twin_py.explanation.damage import damage_remarks

    assert any("damage is extrapolated" in line for line in damage_remarks(weak, run.damage))


def test_flanks_that_yield_within_their_curve_are_named(scene):
    from planetary_twin_py.explanation.damage import damage_remarks

    hard = pt.load_scene(scene())
    run = pt.simulate(hard, 0.2)
    stress = run.damage.peaks["contact_stress"]
    for factor, yields in ((1.9e9, False), (2.2e9, True), (2.6e9, False)):
        scaled = {**run.damage.peaks, "contact_stress": stress * factor / stress[:3].max()}
        lines = list(damage_remarks(hard, replace(run.damage, peaks=scaled)))
        named = [line for line in lines if "flanks of the sun yield above 2000 MPa" in line]
        assert bool(named) == yields
        assert not named or named[0].startswith("contact stress = 2200 MPa: ")
