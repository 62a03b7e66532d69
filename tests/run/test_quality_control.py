"""The best setting a live twin can afford, chosen from synthetic costs."""

import itertools
import random
from collections.abc import Callable

import pytest

from planetary_twin_py.run.quality_control import (
    DEARER,
    QualityControl,
    Setting,
    settings_of,
)
from planetary_twin_py.run.tolerance import LADDER, LIVE_TOLERANCE, TOLERANCES, ladder_of

PERIOD, SHARE = 0.01, 0.4
FULL = 50e3  # [Hz]
Load = Callable[[float], float]


def power_law(at_loosest: float, order: float) -> Load:
    """Share of the time that a window costs, as a method of this order makes it."""
    return lambda tolerance: at_loosest * (LADDER[0] / tolerance) ** (1.0 / order)


def settings(
    policy: QualityControl, cost: Callable[[Setting], float], seconds: float, **kind: bool
):
    """The settings of the windows of `seconds`, each of which takes a share `cost` of its time."""
    chosen = []
    for _ in range(round(seconds / PERIOD)):
        chosen.append(policy.setting)
        policy.observe(*[PERIOD * cost(policy.setting)] * 2, **kind)
    return chosen


def chosen(policy: QualityControl, load: Load, seconds: float) -> list[float]:
    """The tolerances of the windows of `seconds`."""
    return [s.tolerance for s in settings(policy, lambda s: load(s.tolerance), seconds)]


def changes(chosen: list) -> int:
    return sum(a != b for a, b in itertools.pairwise(chosen))


def of(tolerance: float, share: float = SHARE, begin: float = LIVE_TOLERANCE) -> QualityControl:
    ladder = settings_of(ladder_of(tolerance), FULL)
    return QualityControl(ladder, share, PERIOD, Setting(begin, FULL))


def automatic() -> QualityControl:
    return of(0.0)


@pytest.mark.parametrize("order", [3.0, 4.0, 12.0])
@pytest.mark.parametrize("at_loosest", [1e-4, 0.02, 0.07, 0.15, 0.3, 0.9])
def test_it_settles_at_tightest_setting_whose_cost_is_allowed(order, at_loosest):
    load = power_law(at_loosest, order)
    settled = set(chosen(automatic(), load, 30.0)[-500:])
    assert len(settled) == 1
    (tolerance,) = settled
    assert load(tolerance) <= SHARE or tolerance == LADDER[0]
    assert tolerance == LADDER[-1] or load(LADDER[LADDER.index(tolerance) + 1]) > SHARE


@pytest.mark.parametrize("load", [1.2, 2.0, 8.0])
def test_two_windows_that_are_too_late_loosen_at_once(load):
    policy = automatic()
    chosen(policy, lambda _: 0.01, 5.0)
    first, second, third = chosen(policy, lambda _: load, 3 * PERIOD)
    assert first == second == LADDER[-1]
    assert third > LADDER[-1]
    # By as many rungs as bring the cost below the share, at the steepest it may fall.
    rungs = LADDER.index(LADDER[-1]) - LADDER.index(third)
    assert load / DEARER**rungs <= SHARE or third == LADDER[0]
    assert load / DEARER ** (rungs - 1) > SHARE


@pytest.mark.parametrize("seed", range(5))
def test_a_noisy_cost_at_the_limit_does_not_make_it_swing(seed):
    noise = random.Random(seed)
    # The share lies just above the cost of one rung, so that noise asks for both neighbours.
    law = power_law(0.95 * SHARE / DEARER**4, 3.0)
    tolerances = chosen(automatic(), lambda t: law(t) * noise.lognormvariate(0.0, 0.3), 600.0)
    assert changes(tolerances) < 40
    assert changes(tolerances[-20_000:]) <= 8  # in the last 200 s


def test_after_an_overload_it_tightens_again_but_not_soon():
    policy = automatic()
    load = power_law(0.05, 4.0)
    calm = chosen(policy, load, 10.0)[-1]
    chosen(policy, lambda _: 3.0, 0.1)
    loosened = policy.setting.tolerance
    assert loosened > calm
    assert set(chosen(policy, load, 1.0)) == {loosened}
    assert chosen(policy, load, 30.0)[-1] == calm


def test_another_operating_point_is_learnt_again():
    policy = automatic()
    for _ in range(4):  # each time a tighter rung proves too dear, the next is tried later
        chosen(policy, lambda t: 2.0 if t < LADDER[0] else 0.01, 64.0)
    assert set(chosen(policy, lambda _: 0.01, 5.0)) == {LADDER[0]}
    policy.relearn()
    assert chosen(policy, lambda _: 0.01, 2.0)[-1] == LADDER[-1]


def test_a_tolerance_of_the_user_is_kept_whatever_it_costs():
    policy = of(2e-5)
    assert set(chosen(policy, lambda _: 5.0, 5.0)) == {2e-5}
    assert set(chosen(policy, lambda _: 0.0, 5.0)) == {2e-5}


@pytest.mark.parametrize("value", [1e-9, 0.2, -1e-3, float("nan"), float("inf")])
def test_a_tolerance_out_of_range_is_refused_in_one_line(value):
    with pytest.raises(ValueError, match=r"^tolerance = .*1e-08 and 0\.1, or 0 for automatic$"):
        ladder_of(value)
    assert ladder_of(0.0) == LADDER
    assert all(TOLERANCES[0] <= rung <= TOLERANCES[1] for rung in LADDER)


# The waveform, which is given up after the tolerance.


def thinning(computing: float, sampling: float) -> Callable[[Setting], float]:
    """A share for computing, and one for samples that goes with their rate."""
    return lambda setting: computing + sampling * setting.sample_rate / FULL


def test_an_overload_takes_tolerance_then_waveform():
    policy = automatic()
    settings(policy, lambda _: 0.01, 5.0)
    visited = settings(policy, lambda _: 1.3, 5.0)
    ladder = settings_of(LADDER, FULL)
    assert visited[0] == ladder[-1] and visited[-1] == ladder[0]
    assert [ladder.index(s) for s in visited] == sorted(map(ladder.index, visited), reverse=True)
    assert set(settings(policy, lambda _: 1.3, 60.0)) == {ladder[0]}


@pytest.mark.parametrize(("sampling", "rate"), [(0.6, 25e3), (1.2, 12.5e3), (3.0, 6250.0)])
def test_the_waveform_is_thinned_and_does_not_swing(sampling, rate):
    visited = settings(of(2e-5), thinning(0.6, sampling), 600.0)
    assert {s.sample_rate for s in visited[100:]} == {rate}
    assert {s.tolerance for s in visited} == {2e-5}


@pytest.mark.parametrize("tolerance", [0.0, 2e-5])
@pytest.mark.parametrize("repeated", [False, True])
def test_the_waveform_comes_back_when_the_load_has_gone(tolerance, repeated):
    policy = of(tolerance)
    thinned = settings(policy, lambda _: 3.0, 1.0)[-1]
    assert thinned.sample_rate == 6250.0
    calm = settings(policy, thinning(0.05, 0.25), 10.0, repeated=repeated)
    assert calm[50] == thinned
    assert calm[-1].sample_rate == FULL
    rates = [s.sample_rate for s in calm]
    assert rates == sorted(rates)


def test_other_processes_that_hold_windows_up_loosen_nothing():
    policy = automatic()
    for n in range(6000):
        late = n % 40 == 0  # single late windows do not count, see above
        policy.observe((1.2 if late else 0.9) * PERIOD, 0.35 * PERIOD)
        assert policy.setting.tolerance <= LIVE_TOLERANCE and policy.setting.sample_rate == FULL


@pytest.mark.parametrize(("tolerance", "used"), [(0.0, LIVE_TOLERANCE), (1e-5, 1e-5)])
def test_without_deadline_setting_does_not_depend_on_the_load(tolerance, used):
    policy = of(tolerance, begin=1e-2).without_deadline()
    for load in (0.01, 0.5, 3.0):
        assert chosen(policy, lambda tolerance, load=load: load, 3.0) == [used] * 300
        assert policy.setting.sample_rate == FULL
