"""Free motion of a mode against the exponential of its matrix."""

import numpy as np
import pytest
from planetary_twin_core_parts import decay_rates, wave
from scipy.linalg import expm

DAMPING = {  # over the critical one
    "free": 0.0,
    "swinging": 0.05,
    "nearly critical": 1.0 - 1e-12,
    "below critical": 0.999,
    "critical": 1.0,
    "just overdamped": 1.0 + 1e-12,
    "above critical": 1.001,
    "overdamped": 3.0,
    "creeping": 300.0,
}


def motions(square, damping, t):
    """From (1, 0) and (0, 1), with their rates."""
    first, second = wave(damping, *decay_rates(square, damping), t)
    return np.array([[first, second], [-square * second, first - damping * second]])


def exact(square, damping, t):
    return expm(t * np.array([[0.0, 1.0], [-square, -damping]]))


@pytest.mark.parametrize("turn", [0.0, 1e-9, 1e-5, 1e-3, 0.1, 1.0, 3.0, 10.0])
@pytest.mark.parametrize("ratio", DAMPING.values(), ids=DAMPING)
def test_free_motion_is_the_exponential_of_the_matrix(ratio, turn):
    """In units of w = 1, and rates a million times as fast."""
    expected = exact(1.0, 2.0 * ratio, turn)
    size = 1e-13 * (1.0 + ratio * turn)  # norm of the matrix, which is what expm errs by
    assert motions(1.0, 2.0 * ratio, turn) == pytest.approx(expected, rel=1e-11, abs=size)
    w = 1e6
    scale = np.array([[1.0, 1.0 / w], [w, 1.0]])
    found = motions(w * w, 2.0 * ratio * w, turn / w) / scale
    assert found == pytest.approx(expected, rel=1e-11, abs=size)


@pytest.mark.parametrize("damping", [0.0, 1e-9, 1.0, 1e3])
def test_a_mass_without_a_spring_runs_on_or_is_damped(damping):
    for t in (0.0, 1e-6, 1e-2, 1.0, 10.0):
        size = 1e-13 * (1.0 + damping * t)
        expected = exact(0.0, damping, t)
        assert motions(0.0, damping, t) == pytest.approx(expected, rel=1e-11, abs=size)


def test_motions_follow_each_other():
    """Over t and then s as over t + s."""
    for ratio in DAMPING.values():
        parts = motions(1.0, 2.0 * ratio, 0.7) @ motions(1.0, 2.0 * ratio, 1.9)
        whole = motions(1.0, 2.0 * ratio, 2.6)
        assert parts == pytest.approx(whole, rel=1e-11, abs=1e-14 * (1.0 + ratio))
