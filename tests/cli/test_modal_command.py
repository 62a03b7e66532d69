"""The command `modal` against the library."""

import json

import pytest
from typer.testing import CliRunner

import planetary_twin_py as pt
from planetary_twin_py.cli import build_app


def invoke(*arguments):
    return CliRunner().invoke(build_app(), ["modal", *arguments])


@pytest.mark.parametrize(
    "scene, model",
    [("paper", "torsional"), ("paper", "printed"), ("wind_turbine_stage", "spatial")],
)
def test_figures_are_those_of_the_library(scene, model):
    figures = json.loads(invoke(scene, "--model", model, "--json", "-").stdout)
    modes = pt.natural_modes(pt.load_scene(scene), model)
    assert figures["frequencies_hz"] == pytest.approx(modes.frequencies.tolist())
    assert figures["kinds"] == list(modes.kinds)


def test_table_lists_modes_and_resonant_speeds():
    shown = invoke("paper").output
    assert "5500.36" in shown and "planet" in shown
    assert "harmonic 2 of the meshing meets mode 2" in shown


def test_campbell_diagram_is_drawn(tmp_path):
    png = tmp_path / "campbell.png"
    assert invoke("wind_turbine_stage", "--model", "planar", "--campbell", str(png)).exit_code == 0
    assert png.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    "arguments, word",
    [
        (("paper", "--campbell", "/nowhere/campbell.png"), "/nowhere/campbell.png"),
        (("paper", "--campbell", "campbell.doc"), "campbell.doc"),
        (("nowhere",), "nowhere"),
        (("paper", "--model", "flat"), "flat"),
        (("paper", "--model", "planar"), "supports"),
        (("paper", "--set", "gearset.teeth.sun=31"), "ring = sun + 2 planet"),
    ],
)
def test_what_cannot_be_ends_in_one_line(arguments, word):
    result = invoke(*arguments)
    assert result.exit_code == 2
    assert word in result.stderr and result.stderr.count("\n") == 1
