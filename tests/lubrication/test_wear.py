"""Wear law: published points of the film factor."""

import numpy as np
import pytest

from planetary_twin_py.lubrication.wear import FILM_FACTORS, depth_of_passage


def test_the_film_factor_is_that_of_priest_and_taylor():
    """1 up to a specific film of 0.5, (2/7) (4 - lambda) up to 4, 0 above."""
    film = np.array([0.0, 0.5, 1.0, 2.25, 4.0, 9.0])
    expected = [1.0, 1.0, 6.0 / 7.0, 0.5, 0.0, 0.0]
    assert FILM_FACTORS["priest_taylor"](film) == pytest.approx(expected, rel=1e-15)
    assert FILM_FACTORS["constant"](film).tolist() == [1.0] * 6


def test_the_width_of_the_contact_cancels():
    """Mean pressure over 2 b, on the sliding way of 2 b |1 - V2/V1|, is k (F/L) |1 - V2/V1|."""
    for half in (1e-5, 2e-4):
        pressure = 1e5 / (2.0 * half)
        way = 2.0 * half * 0.3
        assert depth_of_passage(1e-18, 1e5, 0.3) == pytest.approx(1e-18 * pressure * way, rel=1e-12)
