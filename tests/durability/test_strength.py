"""Lives and sums of damage against closed forms and a published spectrum."""

import math

import numpy as np
import pytest

from planetary_twin_py.durability.strength import FLANK, ROOT, StressCurve

CURVE = FLANK["case_hardened"].curve(1.5e9)


def test_exponents_are_those_of_the_life_factors():
    root = ROOT["case_hardened"].curve(430e6)
    assert CURVE.exponent(0) == pytest.approx(math.log(500.0) / math.log(1.6))
    assert CURVE.exponent(1) == pytest.approx(math.log(200.0) / math.log(1.0 / 0.85))
    assert (root.exponent(0), root.exponent(1)) == pytest.approx((8.738, 49.9), rel=1e-3)


def test_life_is_a_power_of_stress_in_each_part():
    np.testing.assert_allclose(CURVE.life([2.4e9, 1.5e9, 1.275e9]), [1e5, 5e7, 1e10])
    assert CURVE.life(2.0e9) == pytest.approx(5e7 * (1.5 / 2.0) ** CURVE.exponent(0))
    assert CURVE.life(1.0e9) == pytest.approx(1e10 * (1.275 / 1.0) ** CURVE.exponent(1))
    assert CURVE.life(0.0) == math.inf


def test_three_loads_of_a_published_spectrum_do_the_damage_that_is_printed():
    """ISO 6336-6:2019, annex C, as quoted in open code: loads 3, 22 and 44 of a 30-year spectrum.

    The curve passes 1457.05 N/mm^2 at 5e7 cycles. Printed stresses are rounded to 1 N/mm^2, which
    is 1.2 % of the life of load 44.
    """
    slopes = CURVE.exponent(0), CURVE.exponent(1)
    ends = 5000.0 ** (1.0 / slopes[0]), 200.0 ** (-1.0 / slopes[1])
    curve = StressCurve((1e4, 5e7, 1e10), (1457.05e6 * ends[0], 1457.05e6, 1457.05e6 * ends[1]))
    np.testing.assert_allclose(curve.life([2349e6, 2211e6]), [90_500, 202_000], rtol=0.005)
    assert curve.life(1318e6) == pytest.approx(1.31e9, rel=0.02)
    assert curve.damage(2349e6, 2203) == pytest.approx(0.0243, abs=2e-4)
    assert curve.damage(2211e6, 14_960) == pytest.approx(0.0741, abs=4e-4)
    assert curve.damage(1318e6, 1101) == pytest.approx(8.42e-7, rel=0.02)


def test_one_per_cent_of_stress_costs_the_exponent_in_damage():
    once = CURVE.damage([1.7e9, 1.9e9], [1e5, 1e4])
    assert CURVE.damage([1.717e9, 1.919e9], [1e5, 1e4]) / once == pytest.approx(
        1.01 ** CURVE.exponent(0)
    )


def test_an_endless_curve_has_no_damage_below_its_strength():
    endless = FLANK["case_hardened"].curve(1.5e9, "endless")
    assert endless.damage([1.4e9], [1e12]) == 0.0
    assert endless.life(1.6e9) == CURVE.life(1.6e9)


def test_the_sum_does_not_depend_on_the_order():
    chance = np.random.default_rng(1)
    stress, counts = 1e9 * chance.uniform(0.5, 2.4, 10_000), 10.0 ** chance.uniform(0, 8, 10_000)
    order = chance.permutation(10_000)
    assert CURVE.damage(stress, counts) == CURVE.damage(stress[order], counts[order])


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: CURVE.life(2.5e9), "stress = 2.5e+09 Pa: must be within 0 and 2.4e+09"),
        (lambda: CURVE.life([1e9, math.nan]), "stress = nan Pa: must be within 0 and"),
        (lambda: CURVE.damage(1e9, -1.0), "counts = "),
        (lambda: FLANK["case_hardened"].curve(0.0), "strength = 0.0 Pa: must be above 0"),
    ],
)
def test_what_a_curve_does_not_say_is_refused(call, message):
    with pytest.raises(ValueError) as error:
        call()
    assert str(error.value).startswith(message)
