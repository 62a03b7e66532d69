"""Wrong counts per turn, reversed and exchanged encoders contradict the teeth."""

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.following.checks.encoder_check import EncoderCheck
from planetary_twin_py.following.input_error import InputError
from planetary_twin_py.following.train import followed_train

SCENE = pt.load_scene("paper")
TRAIN = followed_train(SCENE)
RIGHT = 2**20, 2**18


def read(turned, counts=RIGHT, stated=RIGHT, ratio=-3.0 / 7.0, twist=0.0, size=97):
    """Let the check read `turned` [turns of the input], in packets of `size` samples."""
    check = EncoderCheck(TRAIN, stated)
    both = np.stack([turned, ratio * turned + twist], axis=1) * counts
    both = np.floor(both).astype(np.int64)
    for begin in range(0, len(both), size):
        check.add(both[begin : begin + size])


RUNNING = np.linspace(0.0, 12.0, 3001)


@pytest.mark.parametrize("direction", [1.0, -1.0])
def test_right_encoders_pass(direction):
    read(direction * RUNNING + 1e6)


def test_a_reversing_duty_with_one_degree_of_lost_motion_passes():
    turned = 1.5 * np.sin(np.linspace(0.0, 60.0, 20_001))
    read(turned, twist=np.sign(np.gradient(turned)) * 0.5 / 360.0)


@pytest.mark.parametrize("size", [1, 97, 5000])
@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"stated": (2**20, 2**20)}, r"= -0\.1071: must be -0\.4286 .* and 1048576 \(output\)"),
        ({"stated": (2**19, 2**18)}, r"must be -0\.4286 .* 524288 \(input\) and 262144"),
        ({"stated": (2**20, 256_000)}, r"must be -0\.4286 .* 1048576 \(input\) and 256000"),
        ({"counts": (2**20, -(2**18))}, r"= 0\.4286: must be -0\.4286"),
        ({"ratio": -7.0 / 3.0}, r"= -2\.333: must be -0\.4286"),
        ({"ratio": 0.0}, r"= 0: must be -0\.4286"),
    ],
)
def test_wrong_encoders_are_refused_with_their_ratio(wrong, words, size):
    with pytest.raises(InputError, match=words):
        read(RUNNING, **wrong, size=size)
