"""Natural modes at mean mesh stiffness, against closed forms and against the twin that runs."""

import math

import numpy as np
import pytest
from tiers import first

import planetary_twin_py as pt
from planetary_twin_py.explanation.meshes import describe_meshes
from planetary_twin_py.modal.campbell import mesh_line

PAPER = pt.load_scene("paper")
CONTACT_RATIOS = np.array([1.55537, 1.80924])  # of sun-planet and planet-ring meshes
# Teeth in contact, light damping, and a stiffness that varies little: a nearly linear train.
LINEAR = {
    "mesh.double_pair_ratio": 1.2,
    "mesh.damping.law": "viscous",
    "mesh.damping.damping_ratio": 0.01,
    "lubrication.friction": False,
    "drive.speed_limit": pt.rpm(20_000),
}


def mean_stiffnesses(scene):
    """Pairs beyond the first are there for the contact ratio less a ramp and one, of the time."""
    further = CONTACT_RATIOS - scene.mesh.ramp - 1.0
    return 2e8 * (1.0 + (scene.mesh.double_pair_ratio - 1.0) * further)


@pytest.mark.parametrize("model", ["torsional", "machines", "printed"])
def test_modes_are_those_of_constant_stiffness_as_large_as_mean(model):
    sun_planet, planet_ring = mean_stiffnesses(PAPER)
    constant = PAPER.replace(
        **{"mesh.sun_planet_stiffness": sun_planet, "mesh.planet_ring_stiffness": planet_ring}
    )
    mean = pt.natural_modes(PAPER, model, stiffness="mean")
    assert mean.frequencies == pytest.approx(pt.natural_modes(constant, model).frequencies, 1e-5)
    assert mean.kinds == pt.natural_modes(constant, model).kinds


@pytest.mark.parametrize("model", ["planar", "spatial"])
def test_one_pair_in_every_mesh_at_all_times_has_no_other_mean(model):
    scene = pt.load_scene("wind_turbine_stage")
    assert scene.mesh.double_pair_ratio == 1.0
    found = [pt.natural_modes(scene, model, of).frequencies for of in ("single", "mean")]
    assert found[1] == pytest.approx(found[0])
    stiffer = scene.replace(**{"mesh.double_pair_ratio": 1.5})
    raised = pt.natural_modes(stiffer, model, "mean").frequencies
    assert raised[-1] > 1.01 * found[0][-1]


def test_planet_mode_of_computed_teeth_has_mean_of_both_meshes():
    scene = pt.load_scene("cracked_tooth")
    meshes = describe_meshes(scene)
    mass = scene.gearset.equivalent_mass.planet / math.cos(scene.gearset.pressure_angle) ** 2
    for stiffness, field in (("single", "single_stiffness"), ("mean", "mean_stiffness")):
        total = getattr(meshes.sun_planet, field) + getattr(meshes.planet_ring, field)
        modes = pt.natural_modes(scene, stiffness=stiffness)
        expected = math.sqrt(total / mass) / (2 * math.pi)
        assert modes.frequencies[modes.kinds.index("planet")] == pytest.approx(expected)


@pytest.mark.parametrize("harmonic", first(1, [1, 2]))
def test_the_twin_resonates_at_the_mean_stiffness(harmonic):
    scene = PAPER.replace(**LINEAR)
    single, mean = (
        pt.natural_modes(scene, "machines", of).frequencies[3] for of in ("single", "mean")
    )
    assert mean > 1.06 * single
    frequencies = np.linspace(0.97 * single, 1.03 * mean, 41)
    speeds = frequencies / harmonic / abs(mesh_line(scene).slope)
    peak = frequencies[np.argmax([vibration(scene, speed) for speed in speeds])]
    assert peak == pytest.approx(mean, rel=0.015)
    assert peak > 1.05 * single


def vibration(scene, speed):
    """Rms of the first sun DTE about its mean [m], once the start has decayed."""
    dte = pt.simulate(scene.replace(input_speed=speed), duration=0.04).dte[:, 0]
    return dte[len(dte) // 2 :].std()


def test_another_stiffness_and_teeth_that_part_end_in_one_line():
    with pytest.raises(ValueError, match="stiffness = 'double': must be one of single, mean"):
        pt.natural_modes(PAPER, stiffness="double")
    short = PAPER.replace(**{"gearset.addendum": 0.5})
    assert len(pt.natural_modes(short).frequencies) == 5
    with pytest.raises(ValueError, match=r"contact ratio = .*: must be within"):
        pt.natural_modes(short, stiffness="mean")
