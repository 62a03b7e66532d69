"""The loss by a second friction law and how much a thicker oil saves, by both laws."""

import json
import math

import pytest
from command_line import invoke

from planetary_twin_py import load_scene, simulate
from planetary_twin_py.explanation.meshes import describe_meshes
from planetary_twin_py.explanation.oil import oil_figures, oil_of_scenes

# KISSsoft 03/2017 on stage 1 of the NREL 5 MW reference gearbox, tooth loss of one mesh [kW].
KISSSOFT = {"sun_planet": 9.272, "planet_ring": 8.986}
# How much more docs/lubrication.md says that the twin has.
MORE = {"eyring": (0.25, -0.50), "schlenk": (0.19, -0.17)}
STAGE = load_scene("reference_gearbox_stage").replace(
    input_torque=3.94599e6, **{"lubrication.iso_vg": 320}
)


@pytest.mark.parametrize("traction", ["eyring", "schlenk", "evans_johnson"])
def test_exponents_are_the_slopes_of_simulated_losses(traction):
    scene = load_scene("paper").replace(
        dynamics="quasi_static", **{"lubrication.traction": traction}
    )
    own, other = oil_figures(scene).laws
    viscosity = scene.lubrication.viscosity
    thin, thick = (
        simulate(scene.replace(**{"lubrication.viscosity": v}), 0.1).mean_power_loss
        for v in (viscosity / 1.2, 1.2 * viscosity)
    )
    assert own.traction == traction and other.traction == (
        "eyring" if traction == "schlenk" else "schlenk"
    )
    slope = math.log(thick / thin) / math.log(1.44)
    assert own.viscosity_exponent == pytest.approx(slope, abs=0.003)
    assert own.tooth_loss == pytest.approx(simulate(scene, 0.1).mean_power_loss, rel=0.02)


def test_a_study_of_oils_names_a_law_that_favours_thick_ones():
    oils = [STAGE.replace(**{"lubrication.iso_vg": grade}) for grade in (150, 460)]
    hot = [STAGE, STAGE.replace(oil_temperature=353.15)]
    torques = [STAGE, STAGE.replace(input_torque=2e6)]
    assert "likely too thick" in oil_of_scenes(oils) and "likely too thick" in oil_of_scenes(hot)
    assert oil_of_scenes(torques) is None and oil_of_scenes([]) is None


@pytest.mark.parametrize("traction", MORE)
def test_losses_are_near_those_of_another_program(traction):
    changes = {"lubrication.traction": traction, "input_torque": 3.94599e6}
    scene = load_scene("reference_gearbox_stage").replace(**changes)
    meshes, printed = describe_meshes(scene), sum(KISSSOFT.values())
    losses = {name: 1e-3 * getattr(meshes, name).tooth_loss / 3 for name in KISSSOFT}
    more = [losses[name] / KISSSOFT[name] - 1.0 for name in KISSSOFT]
    assert more == pytest.approx(MORE[traction], abs=0.006)
    assert sum(losses.values()) == pytest.approx(printed, rel=0.15)


@pytest.mark.parametrize("changes", [{"input_torque": 0.0}, {"lubrication.friction": False}])
def test_without_tooth_friction_there_is_no_law_to_compare(changes):
    assert oil_figures(load_scene("paper").replace(**changes)) is None


@pytest.mark.parametrize("command", [["simulate", "paper"], ["explain", "paper"]])
def test_commands_print_both_losses_and_export_them(tmp_path, command):
    figures = tmp_path / "figures.json"
    options = ["--duration", "0.02", "--set", "lubrication.traction=eyring", "--json", str(figures)]
    done = invoke(*command, *options)
    assert "by eyring, proportional to viscosity^" in done.stdout
    assert "by schlenk, proportional to viscosity^-0.05" in done.stdout
    laws = json.loads(figures.read_text())["oil"]["laws"]
    assert [law["traction"] for law in laws] == ["eyring", "schlenk"]
