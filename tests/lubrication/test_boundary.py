"""Boundary friction against the values of the pressure form f_b = (tau0 + eps W_a/A_a) A_a."""

import pytest
from lubrication.pitch_point import pitch_point

from planetary_twin_py.dynamics.oil import build_oil
from planetary_twin_py.lubrication.boundary import boundary_shear
from planetary_twin_py.scene import load_scene


def test_boundary_friction_at_the_pitch_point_falls_with_the_lambda_ratio():
    asperities = build_oil(load_scene("paper")).asperities
    area = pitch_point("sp", 1000).area
    friction = [boundary_shear(asperities, x) * area for x in (1.0, 1.25, 1.5, 1.75, 2.0)]
    assert friction == pytest.approx([1.217, 0.662, 0.345, 0.172, 0.082], abs=6e-4)
