"""Worn flanks of a scene against the same material removed in other ways."""

import math

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.model.path_loads import path_loads
from planetary_twin_py.model.teeth import build_tables, stiffness_at

PAPER = pt.load_scene("paper")
PATH = PAPER.gearset.geometry.meshes[0].path
PITCH = PAPER.gearset.geometry.meshes[0].base_pitch


def worn(scene, **fields):
    return scene.replace(**{"mesh.worn.sun_planet": fields})


@pytest.mark.parametrize("entry", ["ramp", "loaded"])
@pytest.mark.parametrize("shape", ["linear", "parabolic"])
def test_wear_of_the_shape_of_relief_is_relief(entry, shape):
    length = 0.3
    scene = PAPER.replace(**{"mesh.entry": entry})
    relieved = scene.replace(
        **{"mesh.tip_relief.sun": {"amount": 4e-6, "length": length * PITCH, "shape": shape}}
    )
    begin = PATH.recess - length
    position = [-PATH.approach, *np.linspace(begin, PATH.recess, 2 if shape == "linear" else 101)]
    share = np.clip((np.array(position) - begin) / length, 0.0, 1.0)
    depth = 4e-6 * (share if shape == "linear" else share**2)
    as_worn = worn(scene, position=position, first=list(depth), second=[0.0] * len(position))
    fraction = np.linspace(0.0, 1.0, 501)
    expected, found = (
        stiffness_at(build_tables(each).teeth, 0, fraction) for each in (relieved, as_worn)
    )
    rel = 1e-9 if shape == "linear" and entry == "ramp" else 5e-3
    if entry == "loaded":  # relief goes on beyond the end of the path, where wear stays constant
        rel = 0.02
    assert found == pytest.approx(expected, rel=rel)
    if entry == "ramp":
        assert (
            np.abs(expected / stiffness_at(build_tables(scene).teeth, 0, fraction) - 1).max() > 0.1
        )


@pytest.mark.parametrize("entry", ["ramp", "loaded"])
def test_loads_on_the_path_are_those_of_the_table(entry):
    position = np.linspace(-PATH.approach, PATH.recess, 61)
    scene = worn(
        PAPER.replace(**{"mesh.entry": entry}),
        position=list(position),
        first=list(2e-6 * position**2),
        second=list(1e-6 * np.abs(position)),
    )
    force = 63.0 / (3.0 * scene.gearset.geometry.sun.base_radius)
    within = np.linspace(-PATH.approach + 0.01, PATH.recess - 0.01, 301)
    found = path_loads(scene, 0).at(within, force)
    stiffness = stiffness_at(build_tables(scene).teeth, 0, within)
    assert force / stiffness == pytest.approx(found.deflection, rel=4e-3)
    others = sum(path_loads(scene, 0).at(within + n, force).load for n in (-1, 1))
    assert found.load + others == pytest.approx(force, rel=1e-9)


def slow(scene):
    return scene.replace(
        dynamics="quasi_static", input_speed=2.0, **{"lubrication.friction": False}
    )


def test_an_even_profile_is_wear_of_all_teeth():
    fault = {"kind": "wear", "gear": "sun", "tooth": "all", "depth": 2e-6}
    ends = [-PATH.approach, PATH.recess]
    profile = worn(PAPER, position=ends, first=[2e-6, 2e-6], second=[0.0, 0.0])
    runs = [
        pt.simulate(slow(scene), 0.2, 2000.0)
        for scene in (PAPER, PAPER.replace(faults=[fault]), profile)
    ]
    plain, faulty, even = (run.dte[:, 0].mean() for run in runs)
    assert faulty - plain == pytest.approx(2e-6, rel=0.02)
    assert even - plain == pytest.approx(2e-6, rel=0.02)


@pytest.mark.parametrize("torque", [63.0, -63.0])
def test_a_planet_worn_in_both_meshes_is_one_on_a_displaced_pin(torque):
    depth, angle = 1e-6, math.radians(21.34)
    mesh = {"position": [-1.0, 1.0], "first": [0.0, 0.0], "second": [0.0, 0.0],
            "planets": [depth, 0.0, 0.0]}  # fmt: skip
    scene = slow(PAPER).replace(input_torque=torque)
    side = math.copysign(1.0, torque)
    pin = [side * depth / math.cos(angle), 0.0, 0.0]
    found = scene.replace(**{"mesh.worn": {"sun_planet": mesh, "planet_ring": mesh}})
    displaced = scene.replace(**{"errors.pin_tangential": pin})
    one, other = (pt.simulate(each, 0.2, 2000.0) for each in (found, displaced))
    assert one.mesh_force == pytest.approx(other.mesh_force, rel=1e-6)
    mean = np.abs(one.mesh["mesh_force_mean"])
    assert mean[0] < 0.95 * mean[1]


@pytest.mark.parametrize(
    "fields, message",
    [
        ({"position": [0.0, 0.0], "first": [0.0, 0.0], "second": [0.0, 0.0]}, r"must increase"),
        ({"position": [0.0, 1.0], "first": [0.0], "second": [0.0, 0.0]}, r"first"),
        ({"position": [0.0, 1.0], "first": [0.0, -1e-6], "second": [0.0, 0.0]},
         r"first\.1 = -1e-06: must be a number within 0 and 0\.001 m"),
        ({"position": [0.0, 1.0], "first": [0.0, 0.0], "second": [0.0, 0.0], "planets": [0.0]},
         r"mesh\.worn\.sun_planet\.planets: has 1 entries: must have 3, one a planet"),
    ],
)  # fmt: skip
def test_impossible_profiles_are_refused(fields, message):
    with pytest.raises(pt.SceneError, match=message):
        worn(PAPER, **fields)


def test_wear_is_for_spur_teeth():
    helical = pt.load_scene("helical_stage").replace(**{"mesh.double_pair_ratio": 1.75})
    ends = {"position": [-0.5, 0.5], "first": [1e-6, 1e-6], "second": [0.0, 0.0]}
    with pytest.raises(pt.SceneError, match=r"mesh\.worn: requires spur teeth"):
        worn(helical, **ends)
