"""Counts of an encoder: errors of its disc, steps and noise."""

import math

import numpy as np
import pytest

from planetary_twin_py.model.layout import Layout
from planetary_twin_py.sensors.bank import SensorBank
from sensors.prescribed import line, read, scene_with, turning

RATE, TURN = 20_000.0, 3.0
ENCODER = {"kind": "encoder", "rate": RATE, "bits": 32, "shaft": "carrier"}
OFF = {"eccentricity": "5 um", "radius": "25 mm"}


def counted(duration=1.0, **own):
    """Angle that an encoder counts [rad], and that of the shaft."""
    scene = scene_with({**ENCODER, **own})
    time = np.arange(round(duration * RATE)) / RATE
    assert SensorBank(Layout(scene)).rate == RATE
    (readings,) = read(scene, turning(scene, time, math.tau * TURN))
    assert readings.unit == "counts" and readings.values.dtype == np.int64
    step = math.tau / scene.sensors[0].counts_per_turn
    return step * (readings.values + 0.5), math.tau * TURN * time, step


def test_an_eccentric_disc_errs_by_200_microradians_once_a_turn():
    """5 um on 25 mm, with one head."""
    shown, angle, _ = counted(**OFF, phase=0.3)
    assert abs(line(shown - angle, RATE, TURN)) == pytest.approx(200e-6, rel=1e-4)
    assert shown - angle == pytest.approx(200e-6 * np.sin(angle - 0.3), abs=1e-8)


@pytest.mark.parametrize("heads", [2, 3, 4])
def test_more_heads_average_the_eccentricity_out(heads):
    shown, angle, step = counted(**OFF, heads=heads)
    assert np.abs(shown - angle).max() <= 0.51 * step


@pytest.mark.parametrize(
    "disc, per_turn", [({"lines": 1024, "bits": None}, 4096), ({"bits": 20}, 2**20)]
)
def test_steps_have_the_variance_of_a_uniform_error(disc, per_turn):
    """step^2/12: 1.73 urad rms of 20 bits."""
    shown, angle, step = counted(**disc, eccentricity="0.3 mm", radius="25 mm")
    assert step == pytest.approx(math.tau / per_turn)
    errors = shown - angle - 0.012 * np.sin(angle)
    assert np.std(errors) == pytest.approx(step / math.sqrt(12.0), rel=0.02)
    assert math.tau / 2**20 / math.sqrt(12.0) == pytest.approx(1.73e-6, rel=1e-3)


def test_noise_is_that_of_a_sample():
    shown, angle, _ = counted(noise=3e-5)
    assert np.std(shown - angle) == pytest.approx(3e-5, rel=0.02)


@pytest.mark.parametrize(
    "shaft, ratio", [("input", 1.0 + 99 / 21), ("sun", 1.0 + 99 / 21), ("output", 1.0)]
)
def test_a_shaft_is_that_of_its_member(shaft, ratio):
    shown, angle, step = counted(shaft=shaft, duration=0.1)
    assert shown == pytest.approx(ratio * angle, abs=step)
