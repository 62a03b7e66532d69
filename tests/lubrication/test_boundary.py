"""Boundary friction against the values of the pressure form f_b = (tau0 + eps W_a/A_a) A_a."""

import pytest
from lubrication.pitch_point import oil_of, pitch_point
from planetary_twin_core_parts import boundary_shear

from planetary_twin_py.scene import load_scene


@pytest.mark.parametrize(
    ("printed", "friction"),
    [
        (False, [1.217, 0.662, 0.345, 0.172, 0.082]),
        (True, [1.208, 0.654, 0.350, 0.212, 0.194]),
    ],
)
def test_boundary_friction_falls_with_the_lambda_ratio(printed, friction):
    """P_m = W_a/A_a as printed: 3.73 GPa at 1.75, -5.59 GPa at 2; by exact functions 1.616 GPa."""
    oil, area = oil_of(load_scene("paper")).asperities, pitch_point("sp", 1000).area
    found = [boundary_shear(oil, printed, x) * area for x in (1.0, 1.25, 1.5, 1.75, 2.0)]
    assert found == pytest.approx(friction, abs=6e-4)


def test_one_modulus_for_all_equations_doubles_the_asperity_load():
    scene = load_scene("paper")
    printed = oil_of(scene.replace(**{"lubrication.modulus": "printed"})).asperities
    assert printed.pressure_factor == pytest.approx(2 * oil_of(scene).asperities.pressure_factor)
