"""Worn flanks of a scene against the same material removed in other ways."""

import numpy as np
import pytest

import planetary_twin_py as pt
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
        plain = stiffness_at(build_tables(scene).teeth, 0, fraction)
        assert np.abs(expected / plain - 1.0).max() > 0.1
