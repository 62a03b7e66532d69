"""Fits of the asperity functions against the integrals they stand for."""

import math

import numpy as np
import pytest
from planetary_twin_core_parts import (
    contact_area_function,
    contact_load_function,
    printed_area_function,
    printed_load_function,
)
from scipy.integrate import quad

BOTH = pytest.mark.parametrize(
    "function, n", [(contact_area_function, 2.0), (contact_load_function, 2.5)]
)


@BOTH
def test_fit_is_within_three_in_ten_thousand_of_the_integral(function, n):
    for x in np.linspace(0.0, 4.0, 81):
        exact = quad(
            lambda s, x=x: (s - x) ** n * math.exp(-0.5 * s * s), x, x + 12.0, epsabs=0, epsrel=1e-9
        )[0]
        assert function(x) == pytest.approx(exact / math.sqrt(2 * math.pi), rel=3e-4)


@BOTH
def test_fit_is_positive_and_never_rises(function, n):
    values = np.array([function(x) for x in np.linspace(0.0, 10.0, 2001)])
    assert values.min() > 0.0
    assert np.diff(values).max() <= 0.0
    assert np.diff(values[:1200]).max() < 0.0


def test_printed_polynomials_have_their_defects():
    ratios = (0.0, 1.0, 1.25, 1.5, 1.75, 2.0, 3.0, 3.01)
    area = [printed_area_function(x) for x in ratios]
    load = [printed_load_function(x) for x in ratios]
    assert area == pytest.approx(
        [0.5, 0.075, 0.04124, 0.020187, 0.006486, -0.004, -0.067, 0.0], abs=1e-6
    )
    assert load == pytest.approx(
        [0.617, 0.08, 0.043328, 0.023188, 0.01407, 0.013, 0.092, 0.0], abs=1e-6
    )
