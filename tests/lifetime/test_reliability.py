"""Weibull distributions against printed lives and closed forms."""

import math

import numpy as np
import pytest

from planetary_twin_py.lifetime.reliability import (
    BEARINGS,
    FLANK,
    ROOT,
    Weibull,
    system_quantile,
    system_reliability,
)

HOURS = 1.0 / 2178.0  # of the ring of the first stage, at 2178 cycles an hour


def test_lives_of_a_ring_flank_are_the_printed_ones():
    """KISSsoft 03/2017 of the NREL 5 MW gearbox, stage 1: t_0 and T of the ring, life 1005 h."""
    ring = Weibull(1.3, 1.973e6 * HOURS, 9.401e6 * HOURS)
    found = ring.quantile([0.01, 0.1, 0.5])
    np.testing.assert_allclose(found, [1005.0, 1509.9, 3478.5], rtol=2e-4)


@pytest.mark.parametrize("scatter", [FLANK, ROOT, *BEARINGS.values()])
def test_a_distribution_passes_its_life_and_its_free_time(scatter):
    found = scatter.weibull(1005.0)
    assert found.reliability(1005.0) == pytest.approx(1.0 - scatter.failures)
    assert found.location == pytest.approx(scatter.free * found.quantile(0.1))
    assert found.reliability(0.999 * found.location) == 1.0
    assert found.reliability(found.scale) == pytest.approx(math.exp(-1.0))


def test_the_ring_follows_from_its_life_alone():
    found = FLANK.weibull(1005.0)
    assert found.location / HOURS == pytest.approx(1.973e6, rel=1e-3)
    assert found.scale / HOURS == pytest.approx(9.401e6, rel=1e-3)


def test_six_bearings_in_series_live_as_one_formula_says():
    one = BEARINGS["roller"].weibull(299_174.0)
    found = system_quantile([one] * 6, 0.1)
    assert found == pytest.approx(299_174.0 * 6.0 ** (-8.0 / 9.0), rel=1e-6)
    assert found == pytest.approx(60_850.0, rel=1e-4)


def test_a_series_survives_with_the_product_of_its_parts():
    parts = [FLANK.weibull(2.0), ROOT.weibull(1.0), BEARINGS["ball"].weibull(1.5)]
    each = [float(part.reliability(1.2)) for part in parts]
    assert system_reliability(parts, 1.2) == pytest.approx(math.prod(each))
    half = system_quantile(parts, 0.5)
    assert system_reliability(parts, half) == pytest.approx(0.5)
    assert system_quantile([], 0.5) == math.inf
    long = FLANK.weibull(1e9)
    assert system_quantile([parts[1], long], 0.1) == pytest.approx(float(parts[1].quantile(0.1)))


def test_survivors_fail_later_by_the_ratio_of_reliabilities():
    part = FLANK.weibull(1.0)
    reached = float(part.quantile(0.3))
    later = part.beyond(reached, 0.5)
    assert part.reliability(later) == pytest.approx(0.5 * 0.7)
    assert part.beyond(0.5 * part.location, 0.0) == pytest.approx(part.location)


def test_gearboxes_that_have_survived_go_on_as_their_share_says():
    parts, ages = [FLANK.weibull(2.0), ROOT.weibull(1.0)], [1.9, 1.1]
    now, later = (
        math.prod(float(p.reliability(a + t)) for p, a in zip(parts, ages, strict=True))
        for t in (0.0, 0.3)
    )
    assert system_reliability(parts, 0.3, ages) == pytest.approx(later / now)
    tenth = system_quantile(parts, 0.1, ages)
    assert system_reliability(parts, tenth, ages) == pytest.approx(0.9)


def test_great_ages_leave_short_times():
    part, age = FLANK.weibull(1.0), 1e3
    left = float(part.beyond(age, 0.5)) - age
    assert part.hazard(age + left) - part.hazard(age) == pytest.approx(math.log(2.0), rel=1e-6)
    assert 0.0 < system_quantile([part], 0.1, [age]) < left < 1.0
