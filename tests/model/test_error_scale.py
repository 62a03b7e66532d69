"""The scale of the tolerance has the backlash at which flanks meet, whatever its law."""

import math

import pytest

import planetary_twin_py as pt
from planetary_twin_py.model.error_scale import StepScale
from planetary_twin_py.model.gearbox import Gearbox

PAPER = pt.load_scene("paper").replace(backlash=4e-5)
ALPHA = PAPER.gearset.transverse.pressure_angle
MEET = {
    ("dead_zone", "line_of_action"): 2e-5,
    ("dead_zone", "pitch_arc"): 2e-5 * math.cos(ALPHA),
    ("regulatory_factor", "line_of_action"): 4e-5,
}


@pytest.mark.parametrize(("law", "motion"), MEET, ids="-".join)
def test_the_scale_adds_the_backlash_where_flanks_meet(law, motion):
    scene = PAPER.replace(**{"mesh.backlash": law, "mesh.motion": motion})
    scale = StepScale(Gearbox(scene))
    point = scene.operating_point
    gap = scale.deflection(point) - scale.elastic_deflection(point)
    assert gap == pytest.approx(MEET[law, motion], rel=1e-12)
