"""Counts per turn and sample rate are compared with the measured speed."""

import numpy as np
import pytest
from following.plants import COUNTS, RATE, paper
from tiers import first, first_rows

from planetary_twin_py.following.channels.encoders import EncoderFormat, EncoderSamples
from planetary_twin_py.following.follower import Follower
from planetary_twin_py.following.input_error import InputError
from planetary_twin_py.following.readings import Readings
from planetary_twin_py.following.train import followed_train

TRAIN = followed_train(paper())
SLOW = 2_000.0  # [Hz]


def followed(
    stated=COUNTS,
    rate=SLOW,
    speed=lambda time: TRAIN.speed,
    sign=1,
    cuts=9,
    lost=None,
    late=0.0,
    reading=1.0,
):
    """A follower of readings and of encoders with COUNTS per turn at 2 kHz, for 8 s."""
    time = np.arange(0.0, 8.0, 1.0 / SLOW)
    omega = np.broadcast_to(speed(time), time.shape)
    turned = np.concatenate([[0.0], np.cumsum(0.5 * (omega[1:] + omega[:-1]))]) / SLOW
    turned /= 2.0 * np.pi
    if lost is not None:
        turned = turned + np.where(time > lost, 1.0, 0.0)
    counts = np.floor(np.stack([turned, TRAIN.ratio * turned], axis=1) * sign * COUNTS)
    follower = Follower(paper(), encoders=EncoderFormat((stated, stated), 1.0 / rate))
    read = time[20::20]
    columns = {
        "input_torque": np.full(len(read), 63.0),
        "output_torque": np.full(len(read), -62.0 / TRAIN.ratio),
        "input_speed": reading * omega[20::20],
    }
    for rows in np.array_split(np.arange(len(read)), cuts):
        follower.add(Readings(read[rows] + late, {name: v[rows] for name, v in columns.items()}))
    for rows in np.array_split(np.arange(len(time)), cuts):
        follower.add(EncoderSamples(rows, counts[rows].astype(np.int64)))
    follower.finish()
    return follower.estimate()


def wandering(time):
    return TRAIN.speed * (1.0 + 0.1 * np.sin(time))


@pytest.mark.parametrize("cuts", first(1, [9, 1]))
@pytest.mark.parametrize("speed", [lambda time: TRAIN.speed, wandering])
def test_encoders_that_turn_with_the_measured_speed_pass(speed, cuts):
    remarks = followed(speed=speed, cuts=cuts).remarks
    assert not any("not checked" in line for line in remarks)


def test_a_lost_turn_is_no_wrong_encoder():
    followed(lost=1.5, speed=lambda time: 0.1 * TRAIN.speed)


@pytest.mark.parametrize("cuts", first(1, [9, 1]))
@pytest.mark.parametrize(
    ("wrong", "said"),
    first_rows(
        2,
        [
            ({"stated": COUNTS // 4}, r"turns 4 times as fast.* 262144 and 262144"),
            ({"sign": -1}, "turns -1 times as fast"),
            ({"rate": 2.0 * SLOW}, r"turns 2 times as fast.* sample rate of 4000 Hz"),
        ],
    ),
)
def test_encoders_that_do_not_are_refused_with_both_figures(wrong, said, cuts):
    with pytest.raises(InputError, match=said):
        followed(**wrong, cuts=cuts)


@pytest.mark.parametrize("factor", [30.0 / np.pi, 180.0 / np.pi])
def test_the_unit_of_the_speed_is_asked_for(factor):
    with pytest.raises(InputError, match="the unit of the speed right"):
        followed(speed=lambda time: 0.1 * TRAIN.speed, reading=factor)


def test_without_a_speed_it_is_said_that_nothing_is_checked():
    follower = Follower(paper(), encoders=EncoderFormat((COUNTS, COUNTS), 1.0 / RATE))
    time = np.arange(0.0, 3.0, 1.0 / RATE)
    turned = TRAIN.speed * time / (2.0 * np.pi)
    counts = np.floor(np.stack([turned, TRAIN.ratio * turned], axis=1) * COUNTS)
    torque = np.arange(1, 300) / 100.0
    follower.add(Readings(torque, {"input_torque": np.full(len(torque), 63.0)}))
    follower.add(EncoderSamples(np.arange(len(time)), counts.astype(np.int64)))
    follower.finish()
    assert any("sample rate are not checked" in line for line in follower.estimate().remarks)


def test_encoders_without_hunting_period_are_named_as_not_judged():
    follower = Follower(paper(), encoders=EncoderFormat((COUNTS, COUNTS), 1.0 / RATE))
    time = np.arange(1, 300) / 100.0
    columns = {
        "input_torque": np.full(len(time), 63.0),
        "output_torque": np.full(len(time), -62.0 / TRAIN.ratio),
        "input_speed": np.full(len(time), TRAIN.speed),
    }
    follower.add(Readings(time, columns))
    follower.finish()
    state = follower.estimate()
    assert state.unchanged == "no change in the torque balance; not judged: teeth"
    assert any(line.startswith("teeth: not judged") for line in state.remarks)
