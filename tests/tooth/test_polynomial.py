"""Polynomials: what is one already comes back as it is."""

import numpy as np
import pytest

from planetary_twin_py.tooth.polynomial import fit


def test_a_polynomial_is_its_own_fit():
    coefficients = np.array([3.0, 0.4, -1.1, 0.2, 0.3])
    found = fit(np.polynomial.Polynomial(coefficients), -0.9, 1.1)
    assert found.coefficients == pytest.approx(coefficients, rel=1e-10)
    assert found.error < 1e-12


def test_error_is_one_dense_grid_shows_and_falls_with_the_degree():
    position = np.linspace(-1.0, 0.8, 4001)
    errors = []
    for degree in (2, 4, 6, 8):
        found = fit(lambda s: 2.0 + np.sin(2 * s), -1.0, 0.8, degree)
        seen = np.polynomial.Polynomial(found.coefficients)(position) / (2 + np.sin(2 * position))
        assert found.error == pytest.approx(np.abs(seen - 1).max(), rel=0.05)
        errors.append(found.error)
    assert np.all(np.diff(errors) < 0)


def test_constant_keeps_its_number_of_coefficients():
    assert fit(lambda s: np.full_like(s, 5.0), -1.0, 1.0).coefficients.shape == (5,)
