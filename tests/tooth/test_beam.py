"""The three integrals against shapes that have a closed form."""

import math

import numpy as np
import pytest

from planetary_twin_py.tooth.beam import Load, beam_compliance
from planetary_twin_py.tooth.material import Material

STEEL = Material(206e9, 0.3)


def test_prism_is_a_cantilever_of_timoshenko():
    """F L^3/3 E'I + 1.2 F L/GA across, F L/E'A along."""
    length, thick = np.array([1e-3, 2e-3, 5e-3]), 0.7e-3
    angle = np.array([0.0, 0.2, 0.5])
    found = beam_compliance(
        lambda x: np.full_like(x, thick), (0.3e-3, 1.2e-3), Load(length, angle), STEEL
    )
    modulus, shear = 206e9 / (1 - 0.3**2), 206e9 / 2.6
    across = length**3 / (3 * modulus * thick**3 / 12) + 1.2 * length / (shear * thick)
    along = length / (modulus * thick)
    expected = np.cos(angle) ** 2 * across + np.sin(angle) ** 2 * along
    assert found == pytest.approx(expected, rel=1e-12)


def test_wedge_bends_as_its_closed_form():
    """Thickness t (L - x)/L: the bending term is 12 L^3/E't^3 ln(L/rest), the others L/t ln()."""
    length, thick, rest = 2e-3, 1e-3, 0.4e-3
    top = np.array([length - rest])
    found = beam_compliance(
        lambda x: thick * (length - x) / length, (), Load(top, np.array([0.0])), STEEL
    )
    u, v = length, rest  # distances from the point of the wedge
    bending = math.log(u / v) - 2 * v * (1 / v - 1 / u) + v**2 / 2 * (1 / v**2 - 1 / u**2)
    modulus, shear = 206e9 / (1 - 0.3**2), 206e9 / 2.6
    expected = 12 * (length / thick) ** 3 * bending / modulus
    expected += 1.2 * length / thick * math.log(u / v) / shear
    assert found[0] == pytest.approx(expected, rel=1e-5)
