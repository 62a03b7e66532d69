"""The accelerometer of a plant against a run with dynamics, and what a follower detects in it."""

import numpy as np
import pytest
from tiers import first

import planetary_twin_py as pt
from planetary_twin_py.following.channels.vibration import VibrationSamples
from planetary_twin_py.following.follower import Follower
from planetary_twin_py.following.readings import Readings
from planetary_twin_py.plant.hidden import Hidden
from planetary_twin_py.plant.readings import Plant, simulate_readings
from planetary_twin_py.plant.sampled import simulate_samples
from planetary_twin_py.plant.vibration import NAME

RATE = 10_000.0  # [Hz]
SCENE = pt.load_scene("paper")
STILL = {"torque_wander": 0.0, "speed_wander": 0.0}


def plant(duration, duty, changes=(), seed=0, **vibration):
    hidden = {
        "duty": duty, "changes": changes, "seed": seed,
        "sensors": {
            "input_torque": {"noise": 0.1}, "output_torque": {"noise": 0.25}, "speed_noise": 0.02,
            "vibration": {"rate": RATE, **vibration},
        },
    }  # fmt: skip
    return Plant(SCENE, Hidden.model_validate(hidden), duration)


def events(played):
    """Events of a follower of readings and vibration."""
    time, columns = simulate_readings(played)
    follower = Follower(SCENE)
    follower.add(Readings(time, columns))
    for one in simulate_samples(played, "vibration"):
        samples = one.sample / RATE, one.values
        follower.add(VibrationSamples(*samples, (NAME,), 1.0 / RATE))
    follower.finish()
    return follower.estimate().events


def of(gear):
    """Events that name a gear."""
    return {f"vibration grew: {lines} of the {gear}" for lines in ("sidebands", "modulation")}


def crack(loss, at=25.0):
    fault = {"kind": "crack", "gear": "sun", "tooth": 7, "stiffness_loss": loss}
    return ({"at": at, "faults": [fault]},)


def test_lines_are_second_derivative_of_the_transmission_error():
    played = plant(1.68, STILL, noise=0.0, path=1.0)  # two hunting periods
    values = np.concatenate([one.values for one in simulate_samples(played, "vibration")])
    mesh = 500.0  # [Hz] of 30 teeth at 1000 rpm
    run = pt.simulate(SCENE, duration=0.84, sample_rate=40_000.0, tolerance=1e-5, settling=1.0)
    train = played.train
    input_, output = (run.angle[:, run.bodies.index(member)] for member in train.members)
    a, b = (float(turns) for turns in train.twist)
    error = train.lever * (a * input_ - b * output)

    def line(signal, rate, order):
        count = round(0.84 * rate)
        wave = np.exp(-2j * np.pi * order * mesh * np.arange(count) / rate)
        return 2.0 * abs(wave @ (signal[:count] - signal[:count].mean())) / count

    for order in (1, 2, 3):
        expected = (2.0 * np.pi * order * mesh) ** 2 * line(error, 40_000.0, order)
        assert line(values, RATE, order) == pytest.approx(expected, rel=0.03)
    assert line(values, RATE, 9) < 1e-3 * line(values, RATE, 1)  # beyond the filter


def test_lost_packets_leave_whole_packets():
    played = plant(10.0, STILL, lost=0.2, packet=100)
    sample = np.concatenate([one.sample for one in simulate_samples(played, "vibration")])
    numbers, counts = np.unique(sample // 100, return_counts=True)
    assert set(counts) == {100} and 0.7 < len(numbers) / 1000 < 0.9


@pytest.mark.exhaustive
@pytest.mark.slow
def test_a_crack_is_detected_as_sidebands_of_its_gear():
    (event,) = events(plant(45.0, {"torque_wander": 0.02}, crack(0.05), seed=2))
    assert event.what == "vibration grew: sidebands of the sun"
    assert event.since <= 25.0 < event.found < 32.0
    assert "a tooth of the sun" in event.causes


@pytest.mark.exhaustive
@pytest.mark.parametrize("gear", ["sun", "planet"])
def test_wear_is_detected_as_sidebands_of_its_gear_alone(gear):
    fault = {"kind": "wear", "gear": gear, "tooth": 7, "depth": 4e-6}
    changes = ({"at": 25.0, "faults": [fault]},)
    found = events(plant(45.0, {"torque_wander": 0.02}, changes))
    measured = {one.what for one in found}
    assert f"vibration grew: sidebands of the {gear}" in measured
    assert measured <= of(gear)


@pytest.mark.exhaustive
@pytest.mark.parametrize("seed", first(2, range(4), pytest.mark.release))
def test_crack_of_one_percent_is_detected_rightly_or_not_at_all(seed):
    for event in events(plant(60.0, {"torque_wander": 0.02}, crack(0.01), seed=seed)):
        assert event.what in of("sun")
        assert event.since <= 25.0


@pytest.mark.exhaustive
@pytest.mark.parametrize("seed", first(1, range(4), pytest.mark.release))
def test_a_healthy_plant_raises_nothing_in_four_minutes(seed):
    assert events(plant(240.0, {}, seed=10 + seed)) == ()
