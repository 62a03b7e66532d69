"""ISO 6336-1 stiffness against the figures of another program for a published example."""

import math

import pytest

from planetary_twin_py.tooth.iso import IsoPair
from planetary_twin_py.tooth.material import Material

STEEL = Material(206e9, 0.3)


def contact_ratio(teeth, shift, module, helix, centres):
    """Transverse contact ratio of 20 deg gears with an addendum of one module (ISO 21771)."""
    transverse = math.atan(math.tan(math.radians(20)) / math.cos(helix))
    radii = [0.5 * module * z / math.cos(helix) for z in teeth]
    base = [r * math.cos(transverse) for r in radii]
    tips = [r + module * (1 + x) for r, x in zip(radii, shift, strict=True)]
    reach = sum(math.sqrt(a**2 - b**2) for a, b in zip(tips, base, strict=True))
    pitch = math.pi * module / math.cos(helix) * math.cos(transverse)
    return (reach - math.sqrt(centres**2 - sum(base) ** 2)) / pitch


def test_helical_pair_has_the_stiffness_that_kisssoft_reports():
    """c'_th 17.85584, c' 12.37047, c_gamma,alpha 17.46485 N/(mm um), reported for example 1.

    z 17/103, z_n 18.905/114.543, m_n 8 mm, 20 deg, 15.8 deg, x 0.145/0, rack D, a 500 mm.
    """
    helix, shift = math.radians(15.8), (0.145, 0.0)
    pair = IsoPair((18.905, 114.543), math.radians(20), shift, 1.40, helix)
    assert pair.theoretical == pytest.approx(17.85584e9, rel=1e-4)
    assert pair.single(STEEL) == pytest.approx(12.37047e9, rel=1e-4)
    ratio = contact_ratio((17, 103), shift, 8.0, helix, 500.0)
    assert pair.mesh(STEEL, ratio) == pytest.approx(17.46485e9, rel=1e-3)


def test_rack_a_pressure_angle_and_modulus_enter_as_factors():
    pair = IsoPair((20, 30), math.radians(20))
    steep = IsoPair((20, 30), math.radians(21.34))
    assert pair.basic_rack_factor == pytest.approx(0.975)
    assert steep.single(STEEL) / pair.single(STEEL) == pytest.approx(1 + 0.02 * 1.34)
    assert pair.single(Material(103e9, 0.3)) == pytest.approx(0.5 * pair.single(STEEL))
    assert IsoPair((20, math.inf), math.radians(20)).theoretical > pair.theoretical
