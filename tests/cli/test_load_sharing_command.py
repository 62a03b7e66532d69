"""The command `load-sharing` against the library."""

import json
from functools import partial

import command_line
import numpy as np
import pytest

import planetary_twin_py as pt

invoke = partial(command_line.invoke, "load-sharing")


def test_figures_are_those_of_the_library():
    figures = json.loads(invoke("floating_sun", "--json", "-").stdout)
    found = pt.load_sharing(pt.load_scene("floating_sun"))
    assert figures["factor"] == pytest.approx(found.factor)
    assert np.array(figures["share"]) == pytest.approx(found.share)
    assert np.array(figures["displacement"]["sun"]) == pytest.approx(found.displacement[:, 0])


def test_the_mean_factor_is_that_without_ripple():
    """All planets of the paper have the same mean share: 1; tooth pairs add 22 % at times."""
    found = pt.load_sharing(pt.load_scene("paper"))
    figures = json.loads(invoke("paper", "--json", "-").stdout)
    assert figures["mean_factor"] == found.mean_factor == pytest.approx(1.0, abs=2e-3)
    assert figures["factor"] > 1.2
    shown = " ".join(invoke("paper").output.split())
    assert f"K_gamma, largest mean over a mesh cycle: {found.mean_factor:.4f}" in shown


def test_the_means_over_each_of_several_mesh_cycles_are_compared():
    scene = pt.load_scene("floating_sun").replace(**{"mesh.runout.sun": 5e-6})
    found = pt.load_sharing(scene)
    teeth, per_cycle = 30, 8
    cycles = found.share.reshape(teeth, per_cycle, 4).mean(axis=1)
    assert found.mean_factor == pytest.approx(cycles.max())


def test_the_warnings_are_in_json_too(tmp_path):
    file = tmp_path / "sharing.json"
    wedged = ("--set", "backlash=0.2um", "--set", "errors.pin_tangential=[-40um,0um,0um,0um]")
    printed = " ".join(invoke("floating_sun", *wedged, "--json", file).output.split())
    (line,) = json.loads(file.read_text())["remarks"]
    assert line.startswith("both flanks of a mesh touch") and f"warning: {line}" in printed
    assert json.loads(invoke("floating_sun", "--json", "-").stdout)["remarks"] == []


def test_a_picture_is_drawn(tmp_path):
    png = tmp_path / "sharing.png"
    assert invoke("floating_sun", "--picture", png).exit_code == 0
    assert png.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize("dynamics", ["planar", "spatial", "quasi_static_spatial"])
def test_statics_of_tilting_axes_are_said_to_be_planar(dynamics):
    said = " ".join(invoke("helical_stage", "--set", f"dynamics={dynamics}").output.split())
    assert ("these statics are planar" in said) == (dynamics != "planar")
