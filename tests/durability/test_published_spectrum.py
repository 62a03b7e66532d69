"""A published 30-year spectrum: from stresses and cycles to the sum of damage.

ISO 6336-6:2019, annex C (17/60 teeth, 35.2 rpm, 70 days of data scaled to 30 years), as quoted in
table_C2.csv of github.com/gfsReboucas/Drivetrain, 2021. Its 42 loaded bins have printed damages
that add up to 0.99945.
"""

import numpy as np
import pytest

from planetary_twin_py.durability.strength import FLANK, StressCurve

CYCLES = np.array([
    2203, 1285, 825.9, 1285, 2570, 1285, 825.9, 1744, 2570, 3028, 2203, 2203, 1744, 2386,
    4772, 4313, 5690, 8076, 6057, 14960, 16520, 7617, 18350, 19460, 9544, 21840, 23220,
    18350, 18900, 27260, 29000, 30650, 32300, 25150, 26250, 37080, 39370, 41210, 42950,
    27810, 16150, 1101,
])  # fmt: skip
STRESS = 1e6 * np.array([
    2349, 2344, 2344, 2340, 2335, 2330, 2326, 2321, 2316, 2312, 2307, 2297, 2293, 2283,
    2274, 2264, 2250, 2240, 2225, 2211, 2191, 2176, 2156, 2131, 2110, 2084, 2053, 2021,
    1988, 1955, 1916, 1870, 1823, 1785, 1742, 1693, 1643, 1593, 1534, 1467, 1398, 1318,
])  # fmt: skip
SHAPE = FLANK["case_hardened"].curve(1457.05e6)


@pytest.fixture(scope="module")
def curve():
    """Through 1457.05 N/mm^2 at 5e7 cycles, drawn on to stresses above the first point."""
    steep = SHAPE.exponent(0)
    first = SHAPE.stress[1] * (SHAPE.cycles[1] / 1e4) ** (1.0 / steep)
    return StressCurve((1e4, *SHAPE.cycles[1:]), (first, *SHAPE.stress[1:]))


def test_the_spectrum_does_the_published_damage(curve):
    assert len(CYCLES) == 42
    assert curve.damage(STRESS, CYCLES) == pytest.approx(0.9996, abs=5e-4)


def test_one_per_cent_more_stress_does_a_seventh_more_damage(curve):
    ratio = curve.damage(1.01 * STRESS, CYCLES) / curve.damage(STRESS, CYCLES)
    assert ratio == pytest.approx(1.140, abs=1e-3)
