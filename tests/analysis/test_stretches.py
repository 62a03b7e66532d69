"""Even stretches between lost blocks and changes of rate."""

import numpy as np
import pytest

from planetary_twin_py.analysis.stretches import even_stretches, longest_stretch

SECOND = np.arange(0.0, 1.0, 1e-3)


def test_a_whole_run_is_one_stretch():
    assert even_stretches(SECOND) == [slice(0, 1000)]


def test_lost_samples_and_other_rates_part_stretches():
    lost = np.delete(SECOND, slice(300, 350))
    assert even_stretches(lost) == [slice(0, 300), slice(300, 950)]
    slower = np.concatenate((SECOND, 1.001 + 2e-3 * np.arange(5)))
    assert even_stretches(slower) == [slice(0, 1000), slice(999, 1005)]
    assert longest_stretch(lost) == slice(300, 950)


def test_a_stretch_does_not_go_back_in_time():
    again = np.concatenate((SECOND, SECOND))
    assert even_stretches(again) == [slice(0, 1000), slice(1000, 2000)]


def test_too_few_samples_are_no_stretch():
    assert even_stretches(SECOND[:2]) == []
    with pytest.raises(ValueError, match="no three"):
        longest_stretch(np.array([0.0, 1.0, 3.0]))
