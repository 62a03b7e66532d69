"""Remaining lives against closed forms of one part and one source of scatter."""

import math

import numpy as np
import pytest

from planetary_twin_py.lifetime.reliability import FLANK, Scatter
from planetary_twin_py.lifetime.remaining_life import Blocks, remaining_life

DAY = 86_400.0
CERTAIN = Scatter(200.0, 0.999, 0.01)  # hardly scatters
STEADY = Blocks(np.full(60, DAY), np.full((60, 1), 1e-3))


def test_a_steady_duty_leaves_the_scatter_of_the_material():
    found = remaining_life(STEADY, [FLANK], np.zeros(1))
    lives = FLANK.weibull(1000.0 * DAY).quantile([0.025, 0.5, 0.975])
    np.testing.assert_allclose(found[:3], lives, rtol=0.03)
    assert found.material_share == pytest.approx(1.0)


def test_a_certain_material_leaves_the_scatter_of_the_mean_duty():
    chance = np.random.default_rng(3)
    damage = chance.lognormal(0.0, 1.0, (60, 1)) * 1e-5
    found = remaining_life(Blocks(np.full(60, DAY), damage), [CERTAIN], np.zeros(1))
    deviation = damage.std() / damage.mean() / math.sqrt(60.0)  # of a mean of sixty
    assert found.material_share < 0.01
    assert math.log(found.high / found.low) == pytest.approx(2 * 1.96 * deviation, rel=0.1)


def test_few_days_to_go_scatter_more_than_their_mean():
    chance = np.random.default_rng(3)
    damage = chance.lognormal(0.0, 0.5, (60, 1))
    damage /= damage.mean()
    ahead = {
        days: remaining_life(Blocks(np.full(60, DAY), damage / days), [CERTAIN], np.zeros(1))
        for days in (10.0, 10_000.0)
    }
    widths = [math.log(found.high / found.low) for found in ahead.values()]
    assert widths[0] / widths[1] == pytest.approx(math.sqrt((1 / 10 + 1 / 60) / (1 / 60)), rel=0.2)


def test_what_has_survived_its_life_goes_on_from_there():
    fresh = remaining_life(STEADY, [FLANK], np.zeros(1))
    used = remaining_life(STEADY, [FLANK], np.array([1.0]))
    part = FLANK.weibull(1000.0 * DAY)
    assert used.median == pytest.approx(
        float(part.beyond(1000.0 * DAY, 0.5)) - 1000 * DAY, rel=0.03
    )
    assert used.median < fresh.median


def test_one_block_has_no_scatter_that_is_known():
    found = remaining_life(Blocks(np.array([DAY]), np.array([[1e-3]])), [FLANK], np.zeros(1))
    assert math.isnan(found.material_share) and found.blocks == 1


def test_parts_without_damage_never_fail():
    both = Blocks(STEADY.length, np.column_stack([STEADY.damage, np.zeros(60)]))
    alone = remaining_life(STEADY, [FLANK], np.zeros(1))
    assert remaining_life(both, [FLANK, CERTAIN], np.zeros(2)) == alone
    nothing = Blocks(STEADY.length, np.zeros((60, 1)))
    assert remaining_life(nothing, [FLANK], np.zeros(1)).low == math.inf
