"""Polynomials through values at fixed nodes."""

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from planetary_twin_py._core import TERMS
from planetary_twin_py.mesh.interpolation import NODES, through


def test_a_polynomial_with_as_many_terms_is_found_again():
    expected = np.random.default_rng(5).uniform(-1.0, 1.0, TERMS)
    assert through(Polynomial(expected)(NODES)) == pytest.approx(expected, abs=1e-11)


def test_a_smooth_function_is_met_between_the_nodes():
    place = np.linspace(0.0, 1.0, 101)
    # Chebyshev's bound: 2^(1 - 2 TERMS) / TERMS! times the largest derivative, 1.
    bound = 2.0 ** (1 - 2 * TERMS) / 720.0
    assert TERMS == 6
    error = Polynomial(through(np.sin(NODES)))(place) - np.sin(place)
    assert 0.1 * bound < np.abs(error).max() < 1.01 * bound


def test_a_constant_has_one_coefficient():
    assert through(np.full(TERMS, 0.7)).tolist() == [0.7] + [0.0] * (TERMS - 1)
