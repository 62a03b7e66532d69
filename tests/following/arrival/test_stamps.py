"""Stamps that are not set, repeat or step back are named or refused."""

import numpy as np
import pytest

from planetary_twin_py.following.arrival.stamps import stamp_remarks, unset_stamps

RISING = np.arange(1.0, 1001.0)


def test_rising_falling_and_shuffled_stamps_pass():
    shuffled = np.random.default_rng(0).permutation(RISING)
    for time in (RISING, RISING[::-1], shuffled):
        assert not list(stamp_remarks(time)) and not unset_stamps(time).any()


def test_stamps_that_are_all_equal_are_refused():
    with pytest.raises(ValueError, match="all 1000 stamps are 0 s; were they never set"):
        list(stamp_remarks(np.zeros(1000)))


@pytest.mark.parametrize("hour", [3600.0, 1800.0])
def test_the_end_of_daylight_saving_is_refused_with_its_row(hour):
    time = 10.0 * RISING
    time[500:] -= hour
    with pytest.raises(ValueError, match=rf"back by {hour - 10:g} s at row 501, and .* UTC"):
        list(stamp_remarks(time))


def test_a_clock_that_was_set_back_is_a_remark():
    time = 0.01 * RISING
    time[500:] -= 0.5
    (line,) = stamp_remarks(time)
    assert line.startswith("time steps back by 0.49 s at row 501, and 50 rows lie between earlier")


def test_parts_in_another_order_are_a_remark():
    (line,) = stamp_remarks(np.concatenate([RISING[500:], RISING[:500]]))
    assert line.startswith("time steps back by 999 s at row 501: rows are used")


def test_stamps_of_0_between_rising_ones_were_not_set():
    time = RISING + 1e9
    time[[0, 300, 301]] = 0.0
    assert list(np.flatnonzero(unset_stamps(time))) == [300, 301]
