"""Blocks of transmission error from counts that are made here."""

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.following.teeth.hunting_blocks import BINS, HuntingBlocks
from planetary_twin_py.following.train import followed_train

N, RATE = 2**24, 20_000.0
TRAIN = followed_train(pt.load_scene("paper"))


def counts_of(error, cycles_per_second=500.0, duration=3.0, turns_back=None):
    """Counts of encoders whose transmission error is `error` over mesh cycles [m]."""
    time = np.arange(int(duration * RATE)) / RATE
    turned = cycles_per_second / 30.0 * time
    if turns_back is not None:
        turned = np.minimum(turned, 2.0 * cycles_per_second / 30.0 * turns_back - turned)
    twist = error(30.0 * turned) / TRAIN.lever / (2.0 * np.pi)
    ring = -3.0 / 7.0 * (turned - twist)
    return np.floor(np.stack([turned, ring], axis=1) * N).astype(np.int64)


def blocks_of(counts, cuts=(), missing=()):
    found = HuntingBlocks(TRAIN, (N, N), 1.0 / RATE)
    kept = np.setdiff1d(np.arange(len(counts)), np.concatenate([*missing, []]).astype(int))
    blocks = []
    for rows in np.split(kept, cuts):
        blocks += found.add(rows, counts[rows])
    return [*blocks, *found.finish()], found.counters


def wave(cycles):
    """Mesh frequency, a swing of the load, and a deep tooth in every 30th mesh cycle."""
    deep = np.exp(-(((np.mod(cycles, 30.0) - 12.5) / 0.2) ** 2))
    return 2e-6 * np.sin(2 * np.pi * cycles) + 5e-6 * np.sin(cycles / 300.0) + 1e-7 * deep


def test_slow_and_common_parts_leave_one_tooth():
    blocks, _ = blocks_of(counts_of(wave))
    assert len(blocks) == 2  # of three and a half hunting periods; the first taught the waveform
    deviation = blocks[0].deviation
    rows = np.abs(deviation).max(axis=1)
    assert set(np.flatnonzero(rows > 4e-8) % 30) == {12}
    assert np.median(np.abs(deviation)) < 5e-9
    at_centre = deviation[12::30, BINS // 2].mean()
    assert at_centre == pytest.approx(1e-7 * 0.98 * (1.0 - 1.0 / 30.0), rel=0.08)


def test_begin_end_and_mean_are_those_of_the_period():
    (first, *_), _ = blocks_of(counts_of(lambda cycles: np.full_like(cycles, 3e-6)))
    assert first.begin == pytest.approx(0.84, abs=1e-3)
    assert first.end == pytest.approx(1.68, abs=1e-3)
    assert first.rate == pytest.approx(500.0, rel=1e-4)
    assert abs(first.mean) < 1e-8  # a count of the ring, from where the counts began


def test_packets_out_of_order_are_put_in_order():
    counts = counts_of(wave)
    found = HuntingBlocks(TRAIN, (N, N), 1.0 / RATE)
    packets = np.split(np.arange(len(counts)), len(counts) // 200)
    packets[10], packets[12] = packets[12], packets[10]
    blocks = [block for rows in packets for block in found.add(rows, counts[rows])]
    blocks += found.finish()
    assert found.counters.late == 0 and found.counters.lost == 0
    assert np.array_equal(blocks[0].deviation, blocks_of(counts)[0][0].deviation)


def test_a_gap_masks_the_bins_near_it():
    missing = np.arange(20_000, 20_200)  # 5 mesh cycles
    (block, *_), counters = blocks_of(counts_of(wave), missing=[missing])
    hole = np.flatnonzero(~block.measured.all(axis=1))
    first = (20_000 / RATE * 500.0) - 420
    assert counters.lost == 200
    assert hole.min() >= first - 5 and hole.max() <= first + 5 + 5
    assert np.median(np.abs(block.deviation[block.measured])) < 5e-9


def test_a_lost_count_of_turns_begins_a_segment():
    counts = counts_of(wave, duration=6.0)
    counts[60_000:, 0] -= N  # one turn of the sun
    blocks, counters = blocks_of(counts)
    assert counters.segments == 2
    assert {block.segment for block in blocks} == {1, 2}


def test_a_reversal_within_a_period_drops_it():
    blocks, counters = blocks_of(counts_of(wave, duration=6.0, turns_back=2.9))
    assert counters.dropped_blocks >= 1
    numbers = [block.number for block in blocks]
    assert numbers == [1, 2, 2, 1] or numbers == [1, 2, 1, 0] or set(numbers) <= {0, 1, 2}
    assert len(numbers) >= 3
