"""Counters that wrap get their turns; counts that jump otherwise stay as they are."""

import numpy as np
import pytest
from following.plants import paper

from planetary_twin_py.following.train import followed_train
from planetary_twin_py.following.whole_turns import WholeTurns

TRAIN, PERIOD = followed_train(paper()), 5e-5
TURNS = 104.72 / (2.0 * np.pi) * PERIOD * np.arange(40_000)


def counted(per_turn, direction=1.0):
    turned = direction * np.stack([TURNS, TRAIN.ratio * TURNS], axis=1)
    return np.floor(turned * per_turn).astype(np.int64)


def added(counts, per_turn, size):
    turns = WholeTurns(TRAIN, (per_turn, per_turn), PERIOD)
    number = np.arange(len(counts))
    parts = [
        turns.add(number[k : k + size], counts[k : k + size]) for k in range(0, len(counts), size)
    ]
    return np.concatenate(parts), list(turns.remarks())


@pytest.mark.parametrize("size", [997, 40_000])
@pytest.mark.parametrize("direction", [1.0, -1.0])
@pytest.mark.parametrize(
    ("per_turn", "span", "low"),
    [(2**20, 2**20, 0), (3600, 3600, 0), (2**20, 2**24, -(2**23)), (3600, 2**16, -(2**15))],
)
def test_counts_of_a_counter_that_wraps_get_their_turns(per_turn, span, low, direction, size):
    whole = counted(per_turn, direction)
    found, lines = added((whole - low) % span + low, per_turn, size)
    assert np.array_equal(np.diff(found, axis=0), np.diff(whole, axis=0))
    assert all(f"jumps by {span} ({span / per_turn:.6g} turns)" in line for line in lines)
    assert lines or span > np.ptp(whole, axis=0).max()


def test_counts_with_whole_turns_and_a_restart_stay_as_they_are():
    whole = counted(2**20)
    whole[30_000:] -= whole[30_000]
    found, lines = added(whole, 2**20, 997)
    assert np.array_equal(found, whole) and not lines
