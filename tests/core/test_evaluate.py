"""Friction of many tooth pairs in vector registers, against that of one pair."""

import itertools

import numpy as np
import pytest
from lubrication.friction_laws import FRICTION_LAWS
from planetary_twin_core_parts import SLOWEST_ROLLING, evaluate

from planetary_twin_py._core import CREEPING, Model, ToothPairs, tooth_contact
from planetary_twin_py.model.oil import build_oil
from planetary_twin_py.scene import friction_table, load_scene

TABLE = friction_table(
    lambda lambda_ratio, sliding_speed: (0.03 + 0.01 * sliding_speed) / (1.0 + lambda_ratio),
    lambda_ratio=(0.1, 1.0, 5.0),
    sliding_speed=(0.01, 0.1, 1.0),
)
PAPER = load_scene("paper").replace(**{"lubrication.friction_table": TABLE})
INPUTS = ("rho1", "rho2", "external", "speed1", "speed2", "load")
RESULTS = (
    "friction",
    "boundary",
    "viscous",
    "log_film",
    "sliding",
    "slope",
    "rolling",
    "rolling_power",
)
LAWS = list(
    itertools.product(
        FRICTION_LAWS,
        ("greenwood_tripp", "load_sharing"),
        ("exact", "printed"),
        ("prescribed", "computed"),
        ("none", "goksem_hargreaves"),
    )
)


def model_of(traction, boundary, asperities, lambda_ratio, rolling):
    scene = PAPER.replace(
        **{
            "lubrication.traction": traction,
            "lubrication.boundary": boundary,
            "lubrication.asperities": asperities,
            "lubrication.lambda_ratio": lambda_ratio,
            "lubrication.rolling": rolling,
        }
    )
    return Model(oil=build_oil(scene, scene.operating_point))


def random_pairs(count, random):
    """Tooth pairs of any speed and load, some of them without load, some at the pitch point."""
    rho1 = random.uniform(1e-3, 2e-2, count)
    rho2 = rho1 * random.uniform(1.1, 3.0, count)
    external = random.choice([1.0, -1.0], count)
    speed1 = random.choice([1.0, -1.0], count) * 10.0 ** random.uniform(-4, 3, count)
    speed2 = -external * speed1 * rho1 / rho2 * random.choice([1.0, 0.9, 1.2, -0.3], count)
    load = random.choice([0.0, 1e-7, 1.0, 1e3, 1e5], count)
    return dict(zip(INPUTS, (rho1, rho2, external, speed1, speed2, load), strict=True))


def pairs_of(values, slowest_rolling=SLOWEST_ROLLING):
    count = len(values["load"])
    return ToothPairs(count=count, slowest_rolling=slowest_rolling, **values)


@pytest.mark.parametrize("laws", LAWS, ids="-".join)
def test_pairs_side_by_side_have_friction_of_each_to_last_bit(laws):
    model, random = model_of(*laws), np.random.default_rng(len("-".join(laws)))
    for count in (1, 5, 8, 12, 48):
        values = random_pairs(count, random)
        pairs = pairs_of(values, slowest_rolling=1e-3)
        evaluate(model, pairs)
        found = np.array([getattr(pairs, name)[:count] for name in RESULTS]).T
        columns = zip(*values.values(), strict=True)
        assert np.isfinite(found).all()
        expected = [tooth_contact(model.oil, tuple(map(float, one)), 1e-3) for one in columns]
        assert np.array_equal(found, np.array(expected))


def test_what_follows_the_pairs_does_not_change_them():
    model, random = model_of(*LAWS[0]), np.random.default_rng(3)
    values = random_pairs(11, random)
    alone, followed = pairs_of(values), pairs_of(values)
    for name in INPUTS:
        getattr(followed, name)[11:] = np.nan
    evaluate(model, alone)
    evaluate(model, followed)
    for name in RESULTS:
        assert np.array_equal(getattr(alone, name)[:11], getattr(followed, name)[:11])


@pytest.mark.parametrize("laws", LAWS[::7], ids="-".join)
@pytest.mark.parametrize("name", ["rho1", "speed1", "load"])
def test_nan_stays_visible_in_its_pair_alone(laws, name):
    model, values = model_of(*laws), random_pairs(16, np.random.default_rng(4))
    values["load"][:] = 1e3
    values[name][5] = np.nan
    pairs = pairs_of(values)
    evaluate(model, pairs)
    assert np.flatnonzero(np.isnan(pairs.friction[:16])).tolist() == [5]


def test_friction_vanishes_with_load_and_turns_with_the_sliding():
    model = model_of("evans_johnson", "greenwood_tripp", "exact", "prescribed", "none")
    values = random_pairs(32, np.random.default_rng(5))
    values["load"][:16], values["load"][16:] = 0.0, 500.0
    pairs = pairs_of(values)
    evaluate(model, pairs)
    assert (pairs.friction[:16] == 0.0).all()
    sliding = pairs.sliding[16:32]
    assert (sliding[np.abs(sliding) > 1e-9] != 0.0).any()
    assert np.array_equal(np.sign(pairs.friction[16:32]), np.sign(sliding))
    for speed in ("speed1", "speed2"):
        values[speed] = -values[speed]
    turned = pairs_of(values)
    evaluate(model, turned)
    assert np.array_equal(turned.friction[:32], -pairs.friction[:32])


@pytest.mark.parametrize("traction", ["evans_johnson", "schlenk"])
def test_slope_is_the_growth_of_friction_with_sliding(traction):
    """Near the pitch point, where the tanh layer decides; magnitudes hardly follow the sliding."""
    model = model_of(traction, "greenwood_tripp", "exact", "prescribed", "none")
    rolling, rho = 2.0, 5e-3
    assert rolling > CREEPING
    sliding = np.linspace(-0.05, 0.05, 21)
    step = 1e-6

    def friction(slid):
        first, second = (rolling + 0.5 * slid) / rho, -(rolling - 0.5 * slid) / rho
        ones = np.ones(len(slid))
        pairs = pairs_of(
            dict(
                zip(
                    INPUTS, (rho * ones, rho * ones, ones, first, second, 500.0 * ones), strict=True
                )
            )
        )
        evaluate(model, pairs)
        return pairs.friction[: len(slid)].copy(), pairs.slope[: len(slid)].copy()

    _, slope = friction(sliding)
    high, low = friction(sliding + step)[0], friction(sliding - step)[0]
    assert (high - low) / (2 * step) == pytest.approx(slope, rel=1e-5, abs=slope.max() * 1e-6)
