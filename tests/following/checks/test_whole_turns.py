"""Counters that wrap get their turns; counts that jump otherwise stay as they are."""

import numpy as np
import pytest
from following.plants import paper

from planetary_twin_py.following.checks.sample_check import CountCheck
from planetary_twin_py.following.checks.whole_turns import WholeTurns
from planetary_twin_py.following.train import followed_train

TRAIN, PERIOD = followed_train(paper()), 5e-5
TURNS = 104.72 / (2.0 * np.pi) * PERIOD * np.arange(40_000)


def counted(per_turn, direction=1.0):
    turned = direction * np.stack([TURNS, TRAIN.ratio * TURNS], axis=1)
    return np.floor(turned * per_turn).astype(np.int64)


def added(counts, per_turn, size):
    turns = WholeTurns(CountCheck(TRAIN, (per_turn, per_turn), PERIOD))
    number = np.arange(len(counts))
    parts = [
        turns.add(number[k : k + size], counts[k : k + size]) for k in range(0, len(counts), size)
    ]
    return np.concatenate([kept for _, kept in parts]), list(turns.remarks())


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


@pytest.mark.parametrize("size", [997, 40_000])
@pytest.mark.parametrize("per_turn", [2**20, 600])
def test_counts_after_a_restart_go_on_from_their_new_zero(per_turn, size):
    whole = counted(per_turn)
    whole[30_000:] -= whole[30_000] + 2 * per_turn // 5
    found, lines = added(whole, per_turn, size)
    lost = len(whole) - len(found)
    assert 0 < lost < 200 and not lines  # until the counts follow the shaft
    assert np.array_equal(found, np.delete(whole, slice(30_000, 30_000 + lost), axis=0))


@pytest.mark.parametrize("size", [1, 997, 40_000])
@pytest.mark.parametrize("code", [0, 2**31 - 1, -9999])
@pytest.mark.parametrize("span", [2**20, 2**48])  # of a counter within a turn, and of whole turns
def test_codes_between_counts_are_left_out_and_named(code, span, size):
    rows = slice(30_000, 30_010)
    whole = counted(2**20)
    wrong = whole % span
    wrong[rows] = code
    number = np.arange(len(whole)) if size > 1 else np.arange(29_900, 30_300)
    found, lines = added(wrong[number], 2**20, size)
    right = whole[number][~np.isin(number, np.arange(30_000, 30_010))]
    assert np.array_equal(np.diff(found, axis=0), np.diff(right, axis=0))
    left_out = [line for line in lines if "left out" in line]
    assert left_out  # of both, unless the code is near the begin of a turn
    assert all("jump" in line and "(10 readings, rows " in line for line in left_out)


def test_enough_counts_of_a_wrong_unit_are_used_to_recognise_it():
    whole = counted(2**20)
    found, _ = added(whole, 2**14, 997)  # each step is further than the shaft can turn
    assert len(found) > 1000
    assert np.ptp(found, axis=0) == pytest.approx(np.ptp(whole, axis=0), rel=0.01)
