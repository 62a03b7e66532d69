"""Flash temperatures against quadratures of the moving source of heat."""

import math
import warnings

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import minimize_scalar
from scipy.special import k0e

from planetary_twin_py.durability.flash import HERTZ, Solid, flash_temperature
from planetary_twin_py.text.warning_types import AccuracyWarning

STEEL = Solid(46.0, 7800.0, 470.0)
BRONZE = Solid(60.0, 8800.0, 380.0)
NONE = Solid(46.0 * 1e-30, 7800.0, 470.0)  # takes no heat


def under_the_source(x):
    """Integral over the source before x: with s = x - u^2 it has no singularity."""
    return quad(lambda u: 2.0 * math.sqrt(max(0.0, 1.0 - (x - u * u) ** 2)), 0.0, math.sqrt(x + 1))[
        0
    ]


def test_the_constant_is_that_of_a_semi_elliptic_source():
    best = minimize_scalar(lambda x: -under_the_source(x), bounds=(0.0, 1.0), method="bounded")
    assert best.x == pytest.approx(0.652, abs=2e-3)
    expected = -best.fun * (4.0 / math.pi) / math.sqrt(math.pi) / math.sqrt(2.0)
    assert pytest.approx(expected, rel=2e-4) == HERTZ


def test_a_fast_source_is_as_hot_as_the_plane_moving_source_of_jaeger():
    """Jaeger 1942: a line source that moves over a half-space, by its Bessel function, L = 50."""
    peclet, half, speed = 50.0, 2e-4, 20.0
    diffusivity = speed * half / (2.0 * peclet)
    solid = Solid(diffusivity * 7800.0 * 470.0, 7800.0, 470.0)

    def rise(x):  # for a mean heat flux of 1 and one surface that takes all of it
        def part(s):
            u = peclet * (x - s)  # downstream of the line source if positive
            return math.sqrt(1.0 - s * s) * k0e(abs(u)) * math.exp(min(0.0, 2.0 * u))

        total = quad(part, -1.0, x, limit=400)[0] + quad(part, x, 1.0, limit=400)[0]
        return 4.0 / math.pi * half * total / (math.pi * solid.conductivity)

    exact = max(rise(x) for x in np.linspace(0.5, 0.8, 13))
    friction = 2.0 * half / speed  # against a surface that stands and takes nothing
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AccuracyWarning)  # the other surface stands
        found = flash_temperature(friction, speed, 0.0, half, solid, NONE)
    assert exact * solid.conductivity / half == pytest.approx(0.1572, abs=1e-4)
    assert found == pytest.approx(exact, rel=5e-3)


def test_both_surfaces_share_the_heat_as_their_effusivity_and_speed():
    alone = [flash_temperature(1e4, v, 2 * v, 2e-4, s, NONE) for v, s in ((9, STEEL), (4, BRONZE))]
    both = flash_temperature(1e4, 9.0, 4.0, 2e-4, STEEL, BRONZE)
    # heat over temperature of each surface adds up
    assert 5.0 / both == pytest.approx(9.0 / alone[0] + 4.0 / alone[1])


def test_reversing_all_speeds_changes_nothing():
    forwards = flash_temperature([1e4, 2e4], [9.0, 5.0], [4.0, 6.0], 2e-4, STEEL, BRONZE)
    backwards = flash_temperature([1e4, 2e4], [-9.0, -5.0], [-4.0, -6.0], 2e-4, STEEL, BRONZE)
    np.testing.assert_array_equal(forwards, backwards)


def test_rolling_without_sliding_heats_nothing():
    assert flash_temperature(1e4, 3.0, 3.0, 2e-4, STEEL, STEEL) == 0.0
    assert flash_temperature(0.0, 0.0, 0.0, 2e-4, STEEL, STEEL) == 0.0


def test_a_slow_contact_is_warned_of():
    with pytest.warns(AccuracyWarning, match="Peclet number is below 5"):
        flash_temperature(1e4, 0.01, 0.02, 2e-4, STEEL, STEEL)


def test_a_contact_without_width_is_refused():
    with pytest.raises(ValueError, match=r"^half_width = .*0\.0.* m: must be above 0$"):
        flash_temperature(1e4, 1.0, 2.0, 0.0, STEEL, STEEL)
