"""Local compliance against the stresses below a Hertzian contact."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from planetary_twin_py._core import half_width
from planetary_twin_py.lubrication.hertz import contact_modulus
from planetary_twin_py.tooth.contact import Contact, weber_banaschek, yang_sun
from planetary_twin_py.tooth.material import Material

STEEL = Material(206e9, 0.3)
LOAD, RADIUS, DEPTHS = 94e3, 1.747e-3, (0.65e-3, 0.8e-3)
CONTACT = Contact(np.array([RADIUS]), tuple(np.array([t]) for t in DEPTHS))


def test_weber_is_strain_below_contact_summed_to_the_centre_line():
    """Johnson (1985), eq. 4.46: stresses on the axis of a line contact."""
    half = half_width(LOAD, RADIUS, 1.0, contact_modulus(206e9, 0.3))
    peak = 2 * LOAD / (math.pi * half)

    def strain(z):
        root = math.hypot(half, z)
        along, down = -peak / half * ((half**2 + 2 * z**2) / root - 2 * z), -peak * half / root
        return -((1 - 0.3**2) * down - 0.3 * 1.3 * along) / 206e9

    expected = sum(quad(strain, 0, t)[0] for t in DEPTHS) / LOAD
    assert weber_banaschek(LOAD)(CONTACT, STEEL)[0] == pytest.approx(expected, rel=2e-3)


def test_yang_and_suns_value_for_steel():
    """pi E L/(4 (1 - nu^2)) = 1.778e11 L, whatever the curvature."""
    stiffness = 1 / yang_sun(CONTACT, STEEL)
    assert stiffness == pytest.approx([1.778e11], rel=1e-3)


def test_stiffer_under_more_load():
    light, heavy = (weber_banaschek(f)(CONTACT, STEEL)[0] for f in (1e4, 1e6))
    assert heavy < light
    with pytest.raises(ValueError, match="line_load = 0 N/m"):
        weber_banaschek(0.0)
