"""Small symmetric systems against numpy."""

import numpy as np
import pytest
from planetary_twin_core_parts import factorise, solve

from planetary_twin_py._core import BODIES


@pytest.mark.parametrize("size", [1, 2, 5, 8, 13, BODIES])
def test_solution_of_a_positive_definite_system(size):
    random = np.random.default_rng(size)
    root = random.normal(size=(size, size)) + 2.0 * np.eye(size)
    a, b = np.zeros((BODIES, BODIES)), np.full(BODIES, np.nan)
    a[:size, :size] = root @ root.T
    b[:size] = random.normal(size=size)
    expected = np.linalg.solve(a[:size, :size], b[:size])
    factorise(a, size)
    lower = np.tril(a[:size, :size], -1) + np.diag(1.0 / np.diag(a[:size, :size]))
    assert lower @ lower.T == pytest.approx(root @ root.T, rel=1e-10, abs=1e-10)
    solve(a, size, b)
    assert b[:size] == pytest.approx(expected, rel=1e-8, abs=1e-10)
    assert np.isnan(b[size:]).all()


def test_a_system_that_is_not_positive_definite_shows():
    a, b = np.zeros((BODIES, BODIES)), np.ones(BODIES)
    a[:2, :2] = [[1.0, 2.0], [2.0, 1.0]]
    factorise(a, 2)
    solve(a, 2, b)
    assert not np.isfinite(b[:2]).all()
