"""A cracked tooth in the vibration of a housing whose sensor the planets pass."""

import numpy as np
import pytest
from analysis.gear_sets import gear_set
from tiers import first

import planetary_twin_py as pt
from planetary_twin_py.following.sensors import Sensors
from planetary_twin_py.following.train import followed_train
from planetary_twin_py.following.turning import Turning
from planetary_twin_py.following.vibration.follower import VibrationFollower

SCENE = gear_set((30, 20, 70), angles=["0 deg", "118.8 deg", "241.2 deg"])
TRAIN = followed_train(SCENE)
RATE = 20_000.0  # [Hz]
NOISE = 0.01  # [m/s^2]
LEARNED, BEFORE, AFTER = 24, 28, 6  # hunting periods


def samples(fault, count, seed):
    """Hunting periods of a steady run behind a window of passing planets, with noise."""
    duration = 2.0 * np.pi * TRAIN.hunting_cycles / abs(float(TRAIN.cycles)) / TRAIN.speed
    scene = SCENE.replace(faults=[fault] if fault else [])
    run = pt.simulate(scene, duration + 0.01, sample_rate=4.0 * RATE, settling=1.0)
    sensor = pt.Accelerometer(rate=RATE, noise=0.0)
    values = pt.measure_vibration(scene, run, sensor).values[: round(duration * RATE)]
    chance = np.random.default_rng(seed)
    return np.concatenate(
        [values + NOISE * chance.standard_normal(len(values)) for _ in range(count)]
    )


@pytest.mark.parametrize("gear", first(1, ["planet", "sun"]))
def test_a_crack_names_its_gear_where_planets_pass(gear):
    """A hunting period does not resolve sun and planets of 30/20/70, so both are named."""
    fault = {"kind": "crack", "gear": gear, "tooth": 3, "stiffness_loss": 0.05}
    fault |= {"planet": 2} if gear == "planet" else {}
    values = np.concatenate([samples(None, BEFORE, 1), samples(fault, AFTER, 2)])
    time = np.arange(len(values)) / RATE
    at = np.arange(0.05, time[-1], 0.1)
    course = Turning(at, np.full(len(at), TRAIN.speed), np.full(len(at), TRAIN.torque))
    follower = VibrationFollower(TRAIN, ("ring_top",), 1.0 / RATE, Sensors(learning=LEARNED))
    follower.add(time, values[:, None])
    follower.judge(float(at[-1]), lambda begin, end: course)
    causes = [event.causes for event in follower.events]
    assert causes and all({"a tooth of the sun", "a tooth of the planet"} <= {*of} for of in causes)
    changed = time[-1] * BEFORE / (BEFORE + AFTER)
    assert all(event.since < changed < event.found for event in follower.events)
