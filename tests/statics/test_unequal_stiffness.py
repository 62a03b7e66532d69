"""Planets that differ in the stiffness of meshes and bearings, against closed forms.

A branch sun-planet-ring yields by 1/K_i = 2/(f_i k) + 4 cos^2(alpha)/(p_i k_p) per force, f_i and
p_i the factors on both meshes and on the bearing of its planet. With held axes all branches are
wound up by the same angle, so L_i = N K_i/sum(K). A free sun demands that the forces have no
resultant: of four evenly spaced planets opposite ones carry the same, and each pair what its
branches yield in series.
"""

import math

import numpy as np
import pytest
from planar.published_set import MESH, PIN, scene
from spatial.tilting_scenes import spatial
from tiers import first

from planetary_twin_py import SceneError, load_scene, simulate
from planetary_twin_py.explanation.terms import terms
from planetary_twin_py.modal.natural import natural_modes
from planetary_twin_py.model.layout import Layout
from planetary_twin_py.statics.load_sharing import load_sharing

ANGLE = math.radians(21.34)
MESHES, PINS = (0.8, 1.0, 1.1, 1.0), (1.0, 0.5, 1.0, 2.0)
UNEQUAL = {"planet_stiffness": MESHES, "pin_stiffness": PINS}
HELD, FREE = 1e14, 0.0
QUIET = {"lubrication.friction": False}


def compliances(pins=True):
    meshes = 2.0 / (MESH * np.array(MESHES))
    return meshes + pins * 4.0 * math.cos(ANGLE) ** 2 / (PIN * np.array(PINS))


def with_held_axes(pins=True):
    stiffness = 1.0 / compliances(pins)
    return 4.0 * stiffness / stiffness.sum()


def with_a_free_sun():
    pairs = compliances().reshape(2, 2).sum(axis=0)[[1, 0]]  # planets 2 and 4, 1 and 3
    return np.tile(2.0 * pairs / pairs.sum(), 2)


EXPECTED = pytest.mark.parametrize(
    ("sun", "shares"), [(HELD, with_held_axes()), (FREE, with_a_free_sun())], ids=["held", "free"]
)


@EXPECTED
def test_statics_share_the_load_by_the_stiffness_of_branches(sun, shares):
    assert load_sharing(scene(4, UNEQUAL, sun)).share[0] == pytest.approx(shares, rel=1e-5)


@EXPECTED
@pytest.mark.parametrize("still", first(1, ["", "quasi_static_"]))
def test_runs_with_moving_axes_share_the_load_as_statics(sun, shares, still):
    given = scene(4, UNEQUAL, sun, dynamics=f"{still}planar", **QUIET)
    run = simulate(given, 0.01, settling=0.0 if still else 0.03)
    assert run.axes.mean_load_share == pytest.approx(shares, rel=1e-5 if still else 5e-3)


@pytest.mark.parametrize("dynamics", ["torsional", "quasi_static"])
def test_planets_rigid_on_their_pins_share_load_by_their_meshes(dynamics):
    given = scene(4, UNEQUAL, dynamics=dynamics, **QUIET)
    assert len(Layout(given).groups.leaders) > 1
    forces = simulate(given, 0.01, settling=0.02).mesh["mesh_force_mean"]
    shares = with_held_axes(pins=False)
    assert forces[:4] / forces[:4].mean() == pytest.approx(shares, rel=1e-6)
    assert forces[4:] / forces[4:].mean() == pytest.approx(shares, rel=1e-6)


def test_tilting_axes_share_load_of_spur_gears_as_planar_ones():
    errors = {f"errors.{name}": factors[:3] for name, factors in UNEQUAL.items()}
    given = spatial(helix=0.0, **errors, **QUIET)
    in_space, in_plane = (
        simulate(given.replace(dynamics=f"quasi_static_{kind}"), 0.002).axes.mean_load_share
        for kind in ("spatial", "planar")
    )
    assert np.ptp(in_plane) > 1e-3
    assert in_space == pytest.approx(in_plane, rel=1e-6)


def test_torsional_modes_are_those_of_matrix_of_unequal_planets():
    factors = (0.7, 1.0, 1.3)
    given = load_scene("paper").replace(
        **{"errors.planet_stiffness": factors, "gearset.held": "carrier"}
    )
    mass, slant = given.gearset.rim_masses, math.cos(given.gearset.pressure_angle) ** -2
    k = np.array(factors) * given.mesh.sun_planet_stiffness
    r = np.array(factors) * given.mesh.planet_ring_stiffness
    matrix = np.diag([k.sum(), *(k + r), r.sum()])
    matrix[0, 1:4] = matrix[1:4, 0] = k
    matrix[4, 1:4] = matrix[1:4, 4] = -r
    scale = np.sqrt(slant * np.array([mass.sun, *[mass.planet] * 3, mass.ring]))
    squares = np.linalg.eigvalsh(matrix / np.outer(scale, scale))
    expected = np.sqrt(np.maximum(squares, 0.0)) / (2.0 * np.pi)
    found = natural_modes(given, "torsional").frequencies
    assert found == pytest.approx(expected, rel=1e-9, abs=1e-2)


def test_spatial_modes_of_spur_gears_contain_the_planar_ones():
    errors = {f"errors.{name}": factors[:3] for name, factors in UNEQUAL.items()}
    given = load_scene("wind_turbine_stage").replace(**{"gearset.helix_angle": 0.0, **errors})
    equal, planar, space = (
        natural_modes(each, model).frequencies
        for each, model in (
            (given.replace(errors={}), "planar"),
            (given, "planar"),
            (given, "spatial"),
        )
    )
    assert planar != pytest.approx(equal, rel=0.01, abs=1.0)
    nearest = np.abs(space[:, None] - planar).min(axis=0)
    assert nearest == pytest.approx(0.0, abs=1e-6 * planar[-1])


def test_explain_can_leave_the_differences_out():
    given = scene(4, UNEQUAL, dynamics="planar")
    term = next(term for term in terms(given) if term.name == "unequal stiffness")
    assert given.replace(**term.without).errors == scene(4).errors


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"errors.planet_stiffness": (1.0, 0.0, 1.0)}, "planet_stiffness = 0 of planet 2: must be"),
        ({"errors.planet_stiffness": (1.0, 2.0)}, "has 2 entries: must have 3, one a planet"),
    ],
)
def test_factors_out_of_range_are_refused_in_one_line(changes, said):
    with pytest.raises(SceneError, match=said):
        load_scene("paper").replace(**changes)
