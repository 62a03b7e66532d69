"""A warning where the teeth have more backlash than the scene states, and none where they agree."""

import math

import pytest

from planetary_twin_py import load_scene
from planetary_twin_py.explanation.backlash import backlash_of_scene

SHIFTS = {"sun": -0.1, "planet": -0.05, "ring": 0.2}  # neither mesh has backlash


def scene(ring=0.2, **changes):
    shifts = {f"gearset.profile_shift.{name}": x for name, x in (SHIFTS | {"ring": ring}).items()}
    return load_scene("paper").replace(**shifts, **changes)


def test_a_ring_shift_of_the_wrong_sign_is_named():
    wrong = scene(ring=-0.2)
    more = 4.0 * 0.2 * 0.8 * math.sin(wrong.gearset.pressure_angle)  # [mm] 4 x m sin(alpha)
    line = backlash_of_scene(wrong)
    assert f"the planet-ring meshes a backlash of {more:.3g} mm" in line
    assert "backlash states 0.2 um" in line
    assert line.endswith("with gearset.profile_shift.ring = 0.2 both agree")


def test_a_backlash_that_includes_that_of_teeth_is_accepted():
    assert backlash_of_scene(scene()) is None
    assert backlash_of_scene(scene(ring=-0.2, backlash=0.1e-3)) is None
    assert backlash_of_scene(scene(backlash=1e-4)) is None


def test_a_centre_distance_that_opens_the_sun_meshes_is_named():
    apart = scene().gearset.geometry.meshes[0].centre_distance + 1e-4
    wide = scene(ring=-0.05, **{"gearset.centre_distance": apart})
    line = backlash_of_scene(wide)
    assert "the sun-planet meshes" in line and "ISO 21771" not in line


@pytest.mark.parametrize(
    "name", ["compact_actuator", "reference_gearbox_stage", "floating_sun", "helical_stage"]
)
def test_packaged_gear_sets_agree_with_their_backlash(name):
    assert backlash_of_scene(load_scene(name)) is None
