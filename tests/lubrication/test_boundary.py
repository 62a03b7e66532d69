"""Boundary friction against the values of the pressure form f_b = (tau0 + eps W_a/A_a) A_a."""

import pytest
from lubrication.pitch_point import oil_of, pitch_point
from planetary_twin_core_parts import boundary_shear

from planetary_twin_py.scene import load_scene


def test_boundary_friction_falls_with_the_lambda_ratio():
    asperities = oil_of(load_scene("paper")).asperities
    area = pitch_point("sp", 1000).area
    friction = [boundary_shear(asperities, False, x) * area for x in (1.0, 1.25, 1.5, 1.75, 2.0)]
    assert friction == pytest.approx([1.217, 0.662, 0.345, 0.172, 0.082], abs=6e-4)


def test_the_printed_asperity_pressure_is_negative_at_two():
    """P_m = W_a/A_a: 3.73 GPa at 1.75, -5.59 GPa at 2, where the exact functions give 1.616 GPa."""
    oil = oil_of(load_scene("paper")).asperities
    area = pitch_point("sp", 1000).area
    printed = [boundary_shear(oil, True, x) * area for x in (1.0, 1.25, 1.5, 1.75, 2.0)]
    assert printed == pytest.approx([1.208, 0.654, 0.350, 0.212, 0.194], abs=6e-4)


def test_one_modulus_for_all_equations_doubles_the_asperity_load():
    scene = load_scene("paper")
    printed = oil_of(scene.replace(**{"lubrication.modulus": "printed"})).asperities
    assert printed.pressure_factor == pytest.approx(2 * oil_of(scene).asperities.pressure_factor)
