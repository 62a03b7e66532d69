"""What a follower holds does not grow with time."""

import pickle

import numpy as np
import pytest
from following.teeth.test_hunting_blocks import RATE as FAST
from following.teeth.test_hunting_blocks import TRAIN, N, counts_of, wave

import planetary_twin_py as pt
from planetary_twin_py.following.arrival.clock_watch import ClockWatch
from planetary_twin_py.following.channels.encoders import EncoderFormat, EncoderSamples
from planetary_twin_py.following.follower import Follower
from planetary_twin_py.following.readings import Readings
from planetary_twin_py.following.sensors import Sensors
from planetary_twin_py.following.teeth.hunting_blocks import BINS, MARGIN, MOST, HuntingBlocks
from planetary_twin_py.following.vibration.follower import VibrationFollower

RATE = 2000.0  # [Hz] of the encoders
SCENE = pt.load_scene("paper")
HUNTING = TRAIN.hunting_cycles / 500.0  # [s] at the speed of the scene
FULL = 130  # [s] after which all that holds a certain number of readings is full


def held(one):
    """Bytes of everything that an object refers to."""
    return len(pickle.dumps(one))


def readings(begin, end, chance):
    """Torques and speeds of a steady run at 10 Hz."""
    time = np.arange(round(begin * 10), round(end * 10)) / 10.0
    torque = 63.0 + 0.05 * chance.standard_normal(len(time))
    speed = np.full(len(time), TRAIN.speed)
    columns = {
        "input_torque": torque, "output_torque": -0.985 * torque / TRAIN.ratio,
        "input_speed": speed, "output_speed": TRAIN.ratio * speed,
    }  # fmt: skip
    return Readings(time, columns)


def samples(begin, end, chance):
    """Counts of a steady run with noise of 2 counts."""
    number = np.arange(round(begin * RATE), round(end * RATE))
    turned = number / RATE * 500.0 / 30.0
    counts = np.stack([turned, -3.0 / 7.0 * turned], axis=1) * N
    return EncoderSamples(number, (counts + 2.0 * chance.standard_normal(counts.shape)).astype(int))


def followed(follower, begin, end, chance, measured=True):
    """Pass on the readings and samples of an interval, second by second."""
    for second in range(begin, end):
        if measured:
            follower.add(readings(second, second + 1, chance))
        follower.add(samples(second, second + 1, chance))
        follower.estimate()


@pytest.mark.exhaustive
def test_the_state_of_a_steady_run_does_not_grow():
    follower = Follower(SCENE, Sensors(learning=8), EncoderFormat((N, N), 1.0 / RATE))
    chance = np.random.default_rng(0)
    followed(follower, 0, FULL, chance)
    cycle = 105  # [s] after which as many samples and rows wait as before
    before, periods = held(follower), follower.hunting_periods
    followed(follower, FULL, FULL + cycle, chance)
    assert follower.hunting_periods - periods == pytest.approx(cycle / HUNTING, abs=2)
    assert not follower.estimate().events
    # One number for each of the hunting periods would add 1000; a sample more or less has 32.
    assert abs(held(follower) - before) < 200


def test_the_watch_of_a_clock_does_not_grow():
    watch, sizes = ClockWatch(), []
    for second in range(2000):
        watch.add("rig", np.array([float(second)]), np.array([second + 1e-3]))
        sizes.append(held(watch))
    assert max(sizes[1000:]) == pytest.approx(max(sizes[:1000]), abs=10)


def test_vibration_without_readings_does_not_fill_the_memory():
    follower = VibrationFollower(TRAIN, ("x",), 1e-3, Sensors(learning=8))
    sizes = []
    for second in range(160):
        time = second + np.arange(1000) / 1000.0
        follower.add(time, np.zeros((1000, 1)))
        sizes.append(held(follower))
    assert max(sizes) == pytest.approx(max(sizes[:60]), rel=0.01)
    assert follower.counters.late > 100_000


@pytest.mark.parametrize("moved", [1, 30_000])
def test_a_train_at_rest_does_not_fill_the_memory(moved):
    """At rest from the start, and within a hunting period."""
    blocks = HuntingBlocks(TRAIN, (N, N), 1.0 / FAST)
    begin = counts_of(wave, duration=1.5)[:moved]
    found = list(blocks.add(np.arange(moved), begin))
    sizes, number, chance = [], moved, np.random.default_rng(0)
    for _ in range(120):
        noise = chance.integers(-2, 3, (round(FAST), 2))
        found += blocks.add(number + np.arange(round(FAST)), begin[-1] + noise)
        number += round(FAST)
        sizes.append(held(blocks))
    assert not found
    most = 2 * MOST * BINS * (TRAIN.hunting_cycles + 2 * MARGIN) + 2 * FAST  # samples
    assert max(sizes) < 32 * most  # number, cycle, part and error of each have 8 bytes
    assert max(sizes[60:]) < 1.1 * max(sizes[:60])
