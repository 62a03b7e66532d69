"""Stress at the root of a ring against finite elements, and a printed figure."""

import math

import numpy as np
import pytest
from tiers import first
from tooth.plane_strain import GearModel, quadratic

import planetary_twin_py as pt
from planetary_twin_py.durability.internal_root import internal_root_stress
from planetary_twin_py.gearset.involute import SpurGear
from planetary_twin_py.model.damage import root_stress
from planetary_twin_py.tooth.profile import ToothProfile

RIM, POISSON = 1.2, 0.3


def finite_elements(profile, at):
    """Largest tension along the fillet on the loaded side, for the force 1 N/m."""
    model = GearModel(profile, RIM, at, 0.02)
    moved = model.solve(model.press(at, 0.06)[0]) @ np.array([1.0, 1j])
    side = model.tooth[0][:, 0]
    nodes, stress = model.nodes[side] @ np.array([1.0, 1j]), []
    for n in range(0, 2 * model.CRACK, 2):  # elements of the fillet
        for x in np.array([-1.0, 1.0]) / math.sqrt(3.0):
            _, slope = quadratic(x)
            here = side[n : n + 3]
            stretch = np.real((slope @ moved[here]) / (slope @ nodes[n : n + 3]))
            stress.append(stretch / (1.0 - POISSON**2))
    return max(stress)


@pytest.mark.parametrize("share", first(1, [0.7, 0.3, 0.9]))
def test_stress_is_that_of_finite_elements(share):
    gear = SpurGear(70, 1.0, math.radians(21.34), internal=True)
    profile = ToothProfile(gear)
    at = profile.flank_start + share * (gear.tip_radius - profile.flank_start)
    found = internal_root_stress(gear, RIM, POISSON, np.array([at]))
    assert found[0] == pytest.approx(finite_elements(profile, at), rel=0.003)


def test_a_commercial_program_prints_nearly_the_same_stress():
    # KISSsoft 03/2017 (see test_root_form.py): 95.32 MPa by factors of ISO 6336-3 at the outer
    # point of single contact, for 829 478.6 N on each mesh
    scene = pt.load_scene("reference_gearbox_stage").replace(durability={"ring_root": True})
    mesh = scene.gearset.geometry.meshes[1]
    stress = np.polynomial.Polynomial(root_stress(scene, mesh, 1))
    outer = 1.0 - 2.0 / mesh.path.contact_ratio
    assert 829_478.6 * stress(outer) == pytest.approx(95.32e6, rel=0.02)
    place = np.linspace(-1.0, 1.0, 50)
    along = 0.5 * (mesh.path.recess - mesh.path.approach + mesh.path.contact_ratio * place)
    radius = np.hypot(mesh.second.base_radius, mesh.curvatures_at(along)[1])
    exact = internal_root_stress(mesh.second, RIM, scene.lubrication.poisson_ratio, radius)
    assert stress(place) == pytest.approx(exact / scene.gearset.face_width, rel=0.01)
