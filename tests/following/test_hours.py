"""Intervals that hold over hours, with laws and zeros that the follower does not know."""

import numpy as np
import pytest
from following.gearboxes import Plants
from tiers import first

from planetary_twin_py.following.balance.cusum import KAPPA

PERIOD = 2.0  # [s]


@pytest.mark.parametrize("duty", first(1, ["varied", "reversing", "steady"]))
def test_intervals_hold_at_every_hour_without_an_alarm(duty):
    plants = Plants(duty, "bearings", 64, 3.0 * 3600.0, PERIOD)
    for n, read in enumerate(plants.readings(), 1):
        assert not len(plants.monitor.add(read).steps.since)
        if n * PERIOD % 3600.0 == 0.0:
            for _, error, sd in plants.errors():
                assert np.mean(np.abs(error) <= 1.96 * sd) >= 0.90


def test_drifting_zeros_of_varied_duty_look_like_no_step():
    plants = Plants("varied", "bearings", 6, 2.0 * 3600.0, PERIOD)
    plants.noise *= 0.0
    scores = []
    for read in plants.readings():
        innovations, _ = plants.monitor.alarms.update(read)
        scores.append(innovations.value / innovations.sd)
    assert np.std(scores[len(scores) // 2 :]) < 0.3 * KAPPA
