"""Entry of loaded teeth against springs with gaps that are solved on their own, and its limits."""

import numpy as np
import pytest
from scipy.optimize import brentq, nnls

import planetary_twin_py as pt
from planetary_twin_py.gearset.separation import separation
from planetary_twin_py.mesh.loaded_entry import NEIGHBOURS, Entry
from planetary_twin_py.model.stiffness_laws import loaded_force, stiffness_laws
from planetary_twin_py.model.teeth import build_teeth, stiffness_at

CYCLE = np.linspace(0.0, 1.0, 301)
POLYNOMIALS = 4e-4  # relative error of those through the deflections of a segment
SPRINGS = {"mesh.entry": "loaded", "mesh.double_pair_ratio": 2.0}  # pairs do not share a body


def deflection(scene, kind):
    """Static deflection of a mesh over its cycle by the table of the core [m]."""
    return loaded_force(scene) / stiffness_at(build_teeth(scene), kind, CYCLE)


def springs(scene, kind, missing=lambda position: 0.0):
    """The same: springs of one stiffness behind their gaps carry the force together."""
    mesh, force = scene.gearset.geometry.meshes[kind], loaded_force(scene)
    stiffness = stiffness_laws(scene)[kind].single

    def at(cycle):
        position = cycle + np.arange(-4, 5)
        gap = separation(mesh, position) + missing(position)
        return brentq(
            lambda d: stiffness * np.maximum(d - gap, 0.0).sum() - force, 0.0, 1e-2, xtol=1e-15
        )

    return np.array([at(cycle) for cycle in CYCLE])


@pytest.mark.parametrize("name", ["paper", "floating_sun", "reference_gearbox_stage"])
@pytest.mark.parametrize("kind", [0, 1])
def test_pairs_without_a_common_body_are_springs_behind_gaps(name, kind):
    scene = pt.load_scene(name).replace(**SPRINGS, **given(name), dynamics="torsional")
    np.testing.assert_allclose(deflection(scene, kind), springs(scene, kind), rtol=POLYNOMIALS)


def given(name):
    """Given stiffness, for scenes that compute theirs."""
    if pt.load_scene(name).mesh.stiffness == "given":
        return {}
    stiffness = {f"mesh.{side}_stiffness": 8e9 for side in ("sun_planet", "planet_ring")}
    return {"mesh.stiffness": "given", **stiffness}


@pytest.mark.parametrize("kind", [0, 1])
def test_tip_relief_shortens_the_entry(kind):
    plain = pt.load_scene("paper").replace(**SPRINGS)
    relief = {"amount": 4e-6, "length": 1.2e-3, "shape": "linear"}
    scene = plain.replace(**{"mesh.tip_relief.planet": relief})
    mesh = scene.gearset.geometry.meshes[kind]
    path, length = mesh.path, 1.2e-3 / mesh.base_pitch

    def missing(
        position,
    ):  # the tip of the planet is at the start of sun meshes, at the end of others
        to_tip = position + path.approach if kind == 0 else path.recess - position
        return 4e-6 * np.clip(1.0 - to_tip / length, 0.0, 1.0)

    found = deflection(scene, kind)
    np.testing.assert_allclose(found, springs(scene, kind, missing), rtol=POLYNOMIALS)
    assert np.mean(found) > np.mean(deflection(plain, kind))


@pytest.mark.parametrize("kind", [0, 1])
def test_without_load_pairs_touch_on_their_path_alone(kind):
    """There one pair has its own stiffness, and two are springs with a common body."""
    scene = pt.load_scene("reference_gearbox_stage")
    light = scene.replace(**{"mesh.entry": "loaded", "input_torque": 1e-3})
    law, path = stiffness_laws(light)[kind], scene.gearset.geometry.meshes[kind].path
    rho = 1.0 / law.sharing - 1.0
    expected = []
    for cycle in CYCLE:
        place = cycle + np.arange(-3, 4)
        c = 1.0 / (law.single * law.strength(place[on_path(path, place)]))
        shared = rho * np.sqrt(c.prod()) if len(c) == 2 else 0.0
        expected.append(
            (c.sum() - len(c) * shared) / (c.prod() - shared**2) if len(c) == 2 else 1.0 / c[0]
        )
    found = stiffness_at(build_teeth(light), kind, CYCLE)
    assert np.mean(np.isclose(found, expected, rtol=1e-5)) > 0.98
    np.testing.assert_allclose(np.mean(found), np.mean(expected), rtol=5e-3)


def on_path(path, place):
    return (place >= -path.approach) & (place <= path.recess)


@pytest.mark.parametrize("kind", [0, 1])
def test_two_pairs_are_as_stiff_as_those_of_a_ramp(kind):
    light = pt.load_scene("reference_gearbox_stage").replace(input_torque=1e-3)
    found, stepped = (
        stiffness_at(build_teeth(light.replace(**changes)), kind, CYCLE)
        for changes in ({"mesh.entry": "loaded"}, {"mesh.ramp": 0.0})
    )
    assert np.mean(np.isclose(found, stepped, rtol=3e-3)) > 0.98


@pytest.mark.parametrize("name", ["paper", "reference_gearbox_stage", "compact_actuator"])
@pytest.mark.parametrize("kind", [0, 1])
def test_loads_have_least_energy_behind_their_gaps(name, kind):
    """Springs on common bodies, solved again as least squares of loads that cannot pull."""
    scene = pt.load_scene(name)
    mesh, law, force = (
        scene.gearset.geometry.meshes[kind],
        stiffness_laws(scene)[kind],
        loaded_force(scene),
    )
    entry = Entry(mesh.path, lambda s: separation(mesh, s), law, force)
    loads, bent = entry.loads(CYCLE[::10])
    rho = 2.0 * law.single / (law.base + 2.0 * law.gain * law.sharing) - 1.0
    for cycle, found, deflection in zip(CYCLE[::10], loads / force, bent, strict=True):
        place = cycle + NEIGHBOURS
        gap, inside = separation(mesh, place), np.clip(place, -mesh.path.approach, mesh.path.recess)
        near = np.isfinite(gap)
        stiffness = law.base + law.gain * law.strength(inside[near])
        beside = np.abs(np.subtract.outer(place[near], place[near])).round() == 1.0
        share = (np.eye(near.sum()) + rho * beside) / np.sqrt(np.outer(stiffness, stiffness))
        root = np.linalg.cholesky(share * law.single).T
        right = np.linalg.solve(root.T, -gap[near] * law.single / force)
        expected, _ = nnls(np.vstack([root, np.full(near.sum(), 1e5)]), np.append(right, 1e5))
        np.testing.assert_allclose(found[near], expected, atol=1e-6)
        carrying = expected > 1e-6
        approach = gap[near] + force * share @ expected
        np.testing.assert_allclose(approach[carrying], deflection, rtol=1e-6)


def test_contact_grows_with_the_load_and_changes_without_a_step():
    scene = pt.load_scene("reference_gearbox_stage").replace(**{"mesh.entry": "loaded"})
    means = []
    for torque in (1e6, 2e6, 4e6):
        loaded = scene.replace(input_torque=torque)
        teeth = build_teeth(loaded)
        means.append(contact_ratio(loaded))
        stiffness = stiffness_at(teeth, 0, np.linspace(0.0, 1.0, 20_001))
        assert np.abs(np.diff(stiffness)).max() < 2e-3 * stiffness.max()
    assert means == sorted(means)
    assert means[0] > scene.gearset.geometry.meshes[0].path.contact_ratio


def test_a_run_at_rest_deflects_as_the_springs():
    scene = pt.load_scene("paper").replace(
        **SPRINGS, dynamics="quasi_static", **{"lubrication.friction": False}
    )
    result = pt.simulate(scene, duration=0.1, sample_rate=20_000.0, settling=0.0)
    force = result.mesh_force[:, 0]
    assert force.mean() == pytest.approx(loaded_force(scene), rel=1e-2)
    static = springs(scene, 0)
    backlash = scene.mesh.flanks(scene.operating_point.backlash, scene.gearset.pressure_angle)[0]
    bent = result.dte[:, 0] - backlash
    assert bent.max() == pytest.approx(static.max(), rel=0.05)
    assert bent.min() == pytest.approx(static.min(), rel=0.05)


def test_contact_stays_at_the_tip_off_the_path():
    """Flanks of the planet end at its base circle, at which no involute has a curvature."""
    scene = pt.load_scene("paper").replace(**{"mesh.entry": "loaded", "input_torque": 315.0})
    mesh = scene.gearset.geometry.meshes[1]
    teeth = build_teeth(scene)
    segments = int(teeth.segments[1])
    edges, present = teeth.edge[1][: segments + 1], teeth.present[1][:segments]
    starts = [edges[j] + teeth.shift[1][j, p] for j in range(segments) for p in range(present[j])]
    assert min(mesh.curvatures_at(min(starts))) < 0.0
    for j in range(segments):
        for p in range(present[j]):
            ends = teeth.centre[1][j, p] + teeth.travel[1][j, p] * edges[j : j + 2]
            assert np.all(ends >= -mesh.path.approach - 1e-9)
            assert np.all(ends <= mesh.path.recess + 1e-9)
    run = pt.simulate(scene, 0.01)
    assert 0.98 < run.efficiency < 1.0


@pytest.mark.parametrize("gear", ["sun", "planet"])
def test_a_tip_that_ends_earlier_touches_later(gear):
    """The tip form diameter of chamfered or rounded tips is `gearset.tip_diameter`."""
    scene = pt.load_scene("paper").replace(**SPRINGS)
    tip = 2e3 * getattr(scene.gearset.geometry, gear).tip_radius
    changed = {f"gearset.tip_diameter.{gear}": f"{tip - 0.15:.6f} mm"}
    found, sharp = (contact_ratio(s) for s in (scene.replace(**changed), scene))
    assert found < sharp - 0.02


def contact_ratio(scene):
    """Mean number of pairs of a sun mesh that are in contact."""
    teeth = build_teeth(scene)
    segments = int(teeth.segments[0])
    return float(np.diff(teeth.edge[0][: segments + 1]) @ teeth.present[0][:segments])


@pytest.mark.parametrize(
    ("name", "changes", "message"),
    [
        (
            "wind_turbine_stage",
            {"mesh.double_pair_ratio": 1.5},
            "mesh.entry = 'loaded': requires spur teeth",
        ),
        ("paper", {"mesh.double_pair_ratio": 1.0}, "mesh: entry = 'loaded': requires stiffness:"),
        (
            "paper",
            {"mesh.sun_planet_stiffness": 1e6},
            "mesh.entry = 'loaded': the load bends teeth",
        ),
    ],
)
def test_what_it_does_not_cover_is_refused(name, changes, message):
    with pytest.raises(ValueError) as error:
        pt.simulate(pt.load_scene(name).replace(**{"mesh.entry": "loaded"}, **changes), 0.01)
    assert str(error.value).startswith(message)
