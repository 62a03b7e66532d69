"""The elasto-plastic bristle against its limits: a spring, steady sliding, a loop, rolling."""

import math

import numpy as np
import pytest
from planetary_twin_core_parts import ELASTIC, bristle_rate
from scipy.integrate import quad, solve_ivp

DISPLACEMENT = 5e-7


def at_rest(sliding):
    """Steady share and its slope where nothing rolls."""
    return math.copysign(1.0, sliding), 0.0


def travelled(share, distances, speed=1e-5):
    """Share of friction after each of the distances [m], one after the other."""
    shares = []
    for distance in distances:
        sliding = math.copysign(speed, distance)

        def rate(_, z, sliding=sliding):
            return [bristle_rate(z[0], sliding, *at_rest(sliding), DISPLACEMENT)[0]]

        run = solve_ivp(rate, (0.0, abs(distance) / speed), [share], rtol=1e-10, atol=1e-12)
        share = run.y[0, -1]
        shares.append(share)
    return shares


def test_below_break_away_contact_is_spring_that_does_not_creep():
    there = 0.6 * DISPLACEMENT
    shares = travelled(0.0, [there, -there, -there, there] * 5)
    assert shares == pytest.approx([0.6, 0.0, -0.6, 0.0] * 5, abs=1e-9)


def test_a_contact_at_rest_keeps_its_share_of_friction():
    assert bristle_rate(0.9, 0.0, 0.0, 1e3, DISPLACEMENT)[3] == pytest.approx(
        bristle_rate(0.9, 0.0, 0.0, 1e6, DISPLACEMENT)[3] * 1e3
    )  # only rolling, which widens the layer 1/slope, lets it go
    assert bristle_rate(0.9, 0.0, 0.0, 1e15, DISPLACEMENT)[0] == pytest.approx(0.0, abs=1e-6)


def test_sliding_on_it_comes_to_full_friction_and_stays_there():
    assert travelled(0.0, [20 * DISPLACEMENT])[0] == pytest.approx(1.0, abs=1e-6)
    assert bristle_rate(1.0, 1e-3, 1.0, 0.0, DISPLACEMENT) == pytest.approx(
        (0.0, 2e3, 0.0, 1e-3), rel=1e-15
    )


def test_loop_of_hysteresis_has_area_that_its_branches_enclose():
    """After a reversal friction falls as a spring to -ELASTIC, then bends towards -1."""

    def bend(y):  # of the distance, per share
        phase = math.pi * (y - 0.5 * (1.0 + ELASTIC)) / (1.0 - ELASTIC)
        return (1.0 - y) / (1.0 - (0.5 + 0.5 * math.sin(phase)) * y)

    spring = 1.0 + ELASTIC
    missing = 2.0 * spring - 0.5 * spring**2 + quad(bend, ELASTIC, 1.0)[0]
    stroke, count = 30.0 * DISPLACEMENT, 6000
    steps = np.full(count, stroke / count)
    shares = np.array([1.0, *travelled(1.0, [*-steps, *steps])])
    work = float((0.5 * (shares[1:] + shares[:-1]) * np.r_[-steps, steps]).sum())
    assert work == pytest.approx(2.0 * (stroke - missing * DISPLACEMENT), rel=1e-5)


@pytest.mark.parametrize("slide_to_layer", [1e-6, 0.3, 1.0, 4.0, -0.5])
def test_while_flanks_roll_traction_curve_is_where_share_rests(slide_to_layer):
    layer = 1e-5
    steady = math.tanh(slide_to_layer)
    slope = (1.0 - steady**2) / layer
    rate, decay, gain, slip = bristle_rate(
        steady, slide_to_layer * layer, steady, slope, DISPLACEMENT
    )
    assert rate == pytest.approx(0.0, abs=1e-9 * decay)
    assert decay > 0.0 and gain >= 0.0
    assert slip == pytest.approx(slide_to_layer * layer)


@pytest.mark.parametrize("share, sliding", [(0.3, 2e-5), (0.62, 1e-5), (-0.4, 1e-5), (0.99, 8e-5)])
def test_decay_and_gain_are_the_derivatives_of_the_rate(share, sliding):
    layer = 2e-5

    def rate(z, v):
        steady = math.tanh(v / layer)
        return bristle_rate(z, v, steady, (1.0 - steady**2) / layer, DISPLACEMENT)

    _, decay, gain, _ = rate(share, sliding)
    dz, dv = 1e-7, 1e-11
    by_share = (rate(share + dz, sliding)[0] - rate(share - dz, sliding)[0]) / (2 * dz)
    assert decay == pytest.approx(-by_share, rel=1e-5, abs=1e-6)
    elastic = share * sliding < 0.0 or abs(share) <= ELASTIC * math.tanh(sliding / layer)
    if elastic:  # else it also depends on the speed through the onset of yielding, left out
        by_speed = (rate(share, sliding + dv)[0] - rate(share, sliding - dv)[0]) / (2 * dv)
        assert gain == pytest.approx(by_speed, rel=1e-5)
