"""Interpolation by the nearest four nodes."""

import numpy as np
import pytest

from planetary_twin_py.lifetime.local_cubic import stencil

AXIS = np.array([0.0, 1.0, 2.5, 3.0, 4.2, 6.0])


def at(values, axis, found):
    return (values[found.nodes] * found.weights).sum(axis=1)


def test_a_cubic_is_exact_on_uneven_nodes():
    def cubic(x):
        return 2.0 - x + 0.5 * x**2 - 0.1 * x**3

    where = np.linspace(0.0, 6.0, 101)
    np.testing.assert_allclose(
        at(cubic(AXIS), AXIS, stencil(AXIS, where)), cubic(where), atol=1e-12
    )


def test_lines_go_on_beyond_the_ends():
    values = AXIS**2
    found = stencil(AXIS, np.array([-1.0, 7.0]))
    np.testing.assert_allclose(at(values, AXIS, found), [-1.0, 36.0 + (36.0 - 4.2**2) / 1.8])


@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_short_axes_use_all_of_their_nodes(count):
    axis = AXIS[:count]
    found = stencil(axis, axis)
    assert found.nodes.shape == (count, count)
    np.testing.assert_allclose(at(axis**2, axis, found), axis**2, atol=1e-12)


def test_straight_weights_join_the_two_next_nodes():
    found = stencil(AXIS, np.array([2.0]))
    np.testing.assert_allclose((AXIS[found.nodes] * found.linear).sum(axis=1), 2.0)
    assert np.count_nonzero(found.linear) == 2
