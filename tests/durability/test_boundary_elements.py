"""Boundary elements against bars and beams, whose stresses and displacements are known."""

import numpy as np
import pytest

from planetary_twin_py.durability.boundary_elements import Outline

LENGTH, SIDE = 4.0, 14  # of a bar of height 1, and elements on each of its sides


def bar(poisson):
    """A bar that is held at its left end."""
    corners = np.array([0.0, LENGTH, LENGTH + 1j, 1j])
    share = np.arange(2 * SIDE) / (2 * SIDE)
    nodes = corners[:, None] + (np.roll(corners, -1) - corners)[:, None] * share
    return Outline(nodes.ravel(), np.arange(4 * SIDE) >= 3 * SIDE, poisson)


def pulled(body, traction):
    """Displacements under a traction on its right end, and the place of the end's middle."""
    loads = np.zeros((1, 4 * SIDE, 3), dtype=complex)
    loads[0, SIDE : 2 * SIDE] = traction
    return body.displacements(loads), 3 * SIDE


def test_a_pulled_bar_has_the_stress_of_its_load():
    body = bar(0.0)
    moved, end = pulled(body, 1.0)
    assert moved[0, end] == pytest.approx(LENGTH, rel=1e-5)
    assert body.stress(moved)[0, 1:SIDE] == pytest.approx(1.0, abs=1e-4)


def test_a_bent_bar_has_the_stress_and_deflection_of_a_beam():
    body = bar(0.0)
    moved, end = pulled(body, 1j)
    bent, sheared = LENGTH**3 / (3.0 / 12.0), 1.2 * LENGTH / 0.5  # Timoshenko 1921
    assert moved[0, end].imag == pytest.approx(bent + sheared, rel=0.01)
    middle = body.stress(moved)[0, SIDE // 2 - 1 : SIDE // 2 + 1].mean()
    assert middle == pytest.approx(6.0 * LENGTH / 2.0, rel=0.005)


def test_a_wide_bar_is_stiffer_by_its_hindered_contraction():
    moved, end = pulled(bar(0.3), 1.0)
    assert 0.95 < moved[0, end].real / ((1.0 - 0.3**2) * LENGTH) < 1.0
