"""`planetary-twin wear`: figures, and a scene with the worn flanks."""

import json

import pytest
from command_line import invoke

import planetary_twin_py as pt

LAW = ("--set", "durability.wear.coefficient=1e-18 1/Pa")


def test_the_worn_scene_is_a_scene_of_other_commands(tmp_path):
    out, figures, picture = (tmp_path / name for name in ("worn.yaml", "w.json", "w.png"))
    done = invoke(
        "wear", "paper", *LAW, "--hours", "20h", "--out", out, "--json", figures,
        "--picture", picture,
    )  # fmt: skip
    assert "at [base pitches]" in done.stdout
    assert "fit it with --measured-backlash-change" in done.stderr
    found = json.loads(figures.read_text())
    worn = pt.load_scene(str(out)).mesh.worn
    assert found["flanks"]["sun"]["depth"] == pytest.approx(list(worn.sun_planet.first))
    assert found["flanks"]["ring"]["depth"] == pytest.approx(list(worn.planet_ring.second))
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert "efficiency" in invoke("simulate", out, "--duration", "0.02").stdout


def test_a_measured_backlash_replaces_the_coefficient(tmp_path):
    figures = tmp_path / "w.json"
    done = invoke(
        "wear", "paper", *LAW, "--hours", "20", "--measured-backlash-change", "0.2um",
        "--json", figures,
    )  # fmt: skip
    found = json.loads(figures.read_text())
    assert found["fitted"] is True
    assert found["duration"] == 72_000.0
    assert found["backlash_change"] == pytest.approx(2e-7, rel=1e-3)
    assert "The coefficient is fitted" in done.stderr
