"""Branches and jumps of the backlash oscillator, from the twin's mesh law and integrator.

zeta 0.05, F_m 0.1, F_ah 0.05. Numbers of the impact branch and the jump up: RK4 with 400 and more
steps a period on the same equation. Sweeps hold each frequency ratio for 60 periods.
"""

import math

import numpy as np
import pytest
from model.backlash_oscillator import Oscillator, amplitude

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
