"""Messages on their way to the disk cover less than the flush period, by their stamps."""

import random

import pytest
from numbered import NUMBERS, SETTINGS, START, payload, read_numbers

from planetary_twin_py.recording.container.storage import Storage
from planetary_twin_py.recording.ros2.bag import BagWriter

PERIOD = 0.2  # [s]


def arrivals(kind, seed):
    """Log times [ns] in the order of writing: as they come, in bursts, or of two late topics."""
    chance = random.Random(seed)
    steps = {"steady": lambda: 0.01, "bursts": lambda: chance.choice([1e-5, 0.7])}
    if kind in steps:
        time = 0.0
        for _ in range(200):
            time += steps[kind]()
            yield START + round(time * 1e9)
        return
    for begin in range(0, 100, 20):  # after a stall: 20 of one topic, then 20 of the other
        for _ in range(2):
            yield from (START + round((begin + k) * 1e7) for k in range(20))


@pytest.mark.parametrize("kind", ["steady", "bursts", "after a stall"])
def test_no_timer_is_needed_for_the_loss_of_a_kill_to_be_bounded(tmp_path, kind):
    bag = BagWriter(tmp_path / "bag", Storage(flush_period=PERIOD))
    channel = bag.add_topic(NUMBERS)
    times = []
    for number, time in enumerate(arrivals(kind, 1), start=1):
        bag.write(channel, payload(number), time, time, number)
        times.append(time)
        kept = read_numbers(bag.file)  # what a kill would leave now
        assert kept == list(range(1, len(kept) + 1))
        lost = times[len(kept) :]
        assert not lost or max(lost) - min(lost) < PERIOD * 1e9
    assert len(kept) > 100


def test_a_latched_message_is_flushed_with_the_others(tmp_path):
    bag = BagWriter(tmp_path / "bag", Storage(flush_period=PERIOD))
    numbers, settings = bag.add_topic(NUMBERS), bag.add_topic(SETTINGS)
    bag.write(settings, payload(7), START, START, 1)
    assert read_numbers(bag.file, "/settings") == []
    bag.write(numbers, payload(1), START + round(PERIOD * 1e9), START, 1)
    assert read_numbers(bag.file, "/settings") == [7]


def test_by_default_only_the_size_of_a_chunk_and_flush_write(tmp_path):
    bag = BagWriter(tmp_path / "bag")
    channel = bag.add_topic(NUMBERS)
    for number in range(1, 10):
        bag.write(channel, payload(number), START + number * 10**10, START, number)
    assert read_numbers(bag.file) == []
    bag.flush()
    assert read_numbers(bag.file) == list(range(1, 10))
