"""Uniformly sampled segments between lost blocks and changes of the rate."""

import numpy as np
import pytest

from planetary_twin_py.analysis.sampling.segments import longest_segment, uniform_segments

SECOND = np.arange(0.0, 1.0, 1e-3)


def test_a_whole_run_is_one_segment():
    assert uniform_segments(SECOND) == [slice(0, 1000)]


def test_lost_samples_and_changes_of_the_rate_separate_segments():
    lost = np.delete(SECOND, slice(300, 350))
    assert uniform_segments(lost) == [slice(0, 300), slice(300, 950)]
    slower = np.concatenate((SECOND, 1.001 + 2e-3 * np.arange(5)))
    assert uniform_segments(slower) == [slice(0, 1000), slice(999, 1005)]
    assert longest_segment(lost) == slice(300, 950)


def test_a_segment_does_not_go_back_in_time():
    again = np.concatenate((SECOND, SECOND))
    assert uniform_segments(again) == [slice(0, 1000), slice(1000, 2000)]


def test_too_few_samples_are_no_segment():
    assert uniform_segments(SECOND[:2]) == []
    with pytest.raises(ValueError, match="no three"):
        longest_segment(np.array([0.0, 1.0, 3.0]))
