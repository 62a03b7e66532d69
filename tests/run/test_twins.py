"""Twins together: as each alone, with one thread or many, and none stops another."""

import dataclasses

import numpy as np
import pytest
from stability.sound import PAPER

import planetary_twin_py as pt

SCENES = [
    PAPER.replace(input_torque=0.3, torque_ripple=3.0),
    pt.load_scene("differential"),
    pt.load_scene("wind_turbine_stage"),
    PAPER.replace(dynamics="quasi_static"),
    PAPER,
    *(PAPER.replace(lambda_ratio=x, input_speed=pt.rpm(y)) for x in (1.0, 1.5) for y in (300, 900)),
]
# Teeth of rubber: a torque of 500 N m presses them into one another by more than a base pitch.
SOFT = PAPER.replace(
    **{"mesh.sun_planet_stiffness": 2e6, "mesh.planet_ring_stiffness": 2e6}, input_torque=20.0
)


def assert_same(found, expected):
    """That two windows are the same, to the last bit."""
    one, other = dataclasses.asdict(found), dataclasses.asdict(expected)
    for part in ("waveform", "mesh"):
        one, other = one | one.pop(part), other | other.pop(part)
    for name, value in one.items():
        assert np.array_equal(value, other[name], equal_nan=isinstance(value, np.ndarray)), name


@pytest.mark.parametrize("workers", [1, 2, 5])
def test_windows_are_those_of_twins_alone_in_any_threads(workers):
    twins = pt.Twins(SCENES, 20_000.0, 1e-3, workers)
    alone = [pt.Twin(scene, 20_000.0, 1e-3) for scene in SCENES]
    for duration in (0.01, 0.0123, 0.25):  # the last one is computed in parts
        for twin in (*twins, *alone):
            twin.set(input_torque=twin.operating_point.input_torque * 1.1)
        for found, one in zip(twins.advance(duration), alone, strict=True):
            assert_same(found, one.advance(duration))


def test_a_copy_that_fails_is_named_and_stops_no_other():
    twins, alone = pt.Twins([PAPER, SOFT, PAPER], workers=2), pt.Twin(PAPER)
    assert all(window is not None for window in twins.advance(0.01)) and not twins.failures
    alone.advance(0.01)
    twins[1].set(input_torque=500.0)
    for _ in range(2):
        first, failed, last = twins.advance(0.01)
        expected = alone.advance(0.01)
        assert failed is None
        assert_same(first, expected)
        assert_same(last, expected)
    assert list(twins.failures) == [1] and "deflection of" in str(twins.failures[1])
    assert [twin.time for twin in twins] == [0.03, 0.01, 0.03]


@pytest.mark.parametrize("duration", [0.0, 61.0, 1e-14])
def test_an_impossible_window_is_refused_before_any_advances(duration):
    twins = pt.Twins([PAPER, PAPER])
    with pytest.raises(ValueError, match=r"^duration = "):
        twins.advance(duration)
    assert [twin.time for twin in twins] == [0.0, 0.0]


@pytest.mark.parametrize("workers", [0, -1])
def test_a_number_of_threads_that_cannot_be_is_refused(workers):
    with pytest.raises(ValueError, match=r"^workers = "):
        pt.Twins([PAPER], workers=workers)
