"""Branches and jumps of the backlash oscillator, from the twin's mesh law and integrator.

zeta 0.05, F_m 0.1, F_ah 0.05. Numbers of the impact branch and the jump up: RK4 with 400 and more
steps a period on the same equation. Sweeps hold each frequency ratio for 60 periods.
"""

import math

import numpy as np
import pytest
from model.backlash_oscillator import Oscillator, amplitude
from scipy.integrate import solve_ivp

from planetary_twin_py.simulation.simulate import TOLERANCE

ZETA, MEAN, ALTERNATING = 0.05, 0.1, 0.05
STEP = 0.002  # of the sweeps, where it matters


def linear(ratio):
    return ALTERNATING * ratio**2 / math.hypot(1.0 - ratio**2, 2.0 * ZETA * ratio)


def separates(x):
    return x.min() < 1.0


@pytest.mark.parametrize("ratio, published", [(0.5, 0.0166), (0.7, 0.0476), (0.8, 0.0868)])
def test_below_grazing_response_is_that_of_the_linear_oscillator(ratio, published):
    oscillator = Oscillator()
    oscillator.set(ratio)
    x = oscillator.settled()
    assert amplitude(x) == pytest.approx(linear(ratio), rel=1e-4)
    assert amplitude(x) == pytest.approx(published, abs=6e-5)
    assert x.mean() == pytest.approx(1.0 + MEAN, rel=1e-5)


def test_flanks_part_where_the_amplitude_reaches_the_squeeze():
    """Closed form: W = 0.8206; the sweep passes it in steps of 0.002."""
    oscillator = Oscillator()
    for ratio in (0.7, 0.75, 0.79, 0.8, 0.805):
        oscillator.set(ratio)
        oscillator.settled()
    parted = jumped = math.nan
    for ratio in np.arange(0.81, 0.85, STEP):
        oscillator.set(ratio)
        x = oscillator.settled()
        if separates(x) and math.isnan(parted):
            parted = ratio
        if math.isnan(parted):
            assert amplitude(x) == pytest.approx(linear(ratio), rel=1e-3)
        if amplitude(x) > 2.0 * linear(ratio):
            jumped = ratio
            break
    assert parted - STEP - 1e-9 <= 0.8206 <= parted + 1e-9
    assert jumped == pytest.approx(0.83)  # it grazes until 0.828; so does RK4 on the same sweep


def near_grazing(ratio, tolerance):
    """Settled amplitude of flanks that just part, reached in small steps of the frequency."""
    oscillator = Oscillator(tolerance=tolerance)
    for step in (0.7, 0.75, 0.79, 0.8, 0.805, 0.81, 0.815, 0.82, ratio):
        oscillator.set(step)
        x = oscillator.settled()
    assert separates(x)
    return amplitude(x)


@pytest.mark.parametrize("ratio", [0.822, 0.828])
def test_near_grazing_amplitude_keeps_to_the_default_tolerance(ratio):
    """The tolerance refers to half the backlash, 1; the amplitude is a tenth of it."""
    exact = near_grazing(ratio, 1e-8)
    assert near_grazing(ratio, TOLERANCE) == pytest.approx(exact, abs=TOLERANCE)
    assert near_grazing(ratio, 0.01 * TOLERANCE) == pytest.approx(exact, abs=0.01 * TOLERANCE)


IMPACTS = [
    (0.80, 0.2845, 1.3330, 0.7616),
    (0.90, 0.2297, 1.2976, 0.8392),
    (1.0, 0.1880, 1.2693, 0.8953),
]


@pytest.fixture(scope="module")
def down_sweep():
    """Settled squeeze at ratios from 1.1 down to 0.68, in steps of 0.01."""
    oscillator, found = Oscillator(), {}
    for ratio in (0.8, 0.81, 0.815, 0.82, 0.83, 0.9, 1.0, 1.1):
        oscillator.set(ratio)
        oscillator.settled()
    for hundredths in range(110, 67, -1):
        oscillator.set(hundredths / 100)
        found[hundredths / 100] = oscillator.settled()
    return found


@pytest.mark.parametrize("ratio, size, highest, lowest", IMPACTS)
def test_branch_with_impacts_on_one_side(down_sweep, ratio, size, highest, lowest):
    x = down_sweep[ratio]
    assert amplitude(x) == pytest.approx(size, abs=2e-4)
    assert (x.max(), x.min()) == pytest.approx((highest, lowest), abs=1.5e-3)  # of 64 samples
    assert x.min() > -1.0
    assert x[:64] == pytest.approx(x[-64:], abs=1e-4)  # it repeats with every period


def test_sweeping_down_the_impacts_end_between_071_and_070(down_sweep):
    assert separates(down_sweep[0.71])
    assert not separates(down_sweep[0.70])
    assert amplitude(down_sweep[0.70]) == pytest.approx(linear(0.70), rel=1e-3)


def test_between_the_jumps_two_motions_are_possible(down_sweep):
    oscillator = Oscillator()
    oscillator.set(0.76)
    assert amplitude(oscillator.settled()) == pytest.approx(linear(0.76), rel=1e-3)
    assert amplitude(down_sweep[0.76]) > 3.0 * linear(0.76)


def independent(ratio, mean, alternating, periods):
    """The same equation and start by DOP853, restarted at every crossing of a flank."""
    size = alternating * ratio / math.hypot(ratio, 2.0 * ZETA)
    phase = math.atan2(-2.0 * ZETA, ratio)  # of -e'' - 2 zeta e'

    def rate(t, y, contact):
        force = contact * (contact * y[0] - 1.0) if contact else 0.0
        push = mean + alternating * ratio**2 * math.sin(ratio * t + phase)
        return [y[1], push - 2.0 * ZETA * y[1] - force]

    flanks = [lambda t, y, c: y[0] - 1.0, lambda t, y, c: y[0] + 1.0]
    for flank in flanks:
        flank.terminal = True
    times = 2.0 * math.pi / ratio * np.arange(1, periods * 64 + 1) / 64
    t, y, result = 0.0, np.array([1.0 + mean, -size * ratio]), np.zeros(len(times))
    while t < times[-1]:
        ahead = y[0] + 1e-9 * np.sign(y[1])
        contact = 1 if ahead > 1.0 else -1 if ahead < -1.0 else 0
        run = solve_ivp(
            rate, (t, times[-1]), y, "DOP853", rtol=1e-11, atol=1e-13, dense_output=True,
            events=flanks, args=(contact,), max_step=0.1,
        )  # fmt: skip
        inside = (times > t) & (times <= run.t[-1])
        if inside.any():
            result[inside] = run.sol(times[inside])[0]
        t, y = run.t[-1], run.y[:, -1]
        y[0] += 1e-13 * np.sign(y[1])
    return result


@pytest.mark.parametrize("ratio, alternating", [(0.6, 0.6), (0.9, 0.5), (1.4, 0.5)])
def test_impacts_on_both_sides_follow_an_independent_integrator(ratio, alternating):
    oscillator = Oscillator(mean=0.05, alternating=alternating, tolerance=1e-8)
    oscillator.set(ratio)
    x, other = oscillator.run(8), independent(ratio, 0.05, alternating, 8)
    assert other.min() < -1.0 and other.max() > 1.0
    assert x == pytest.approx(other, abs=2e-5)
