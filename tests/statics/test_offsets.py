"""Axes of ring or carrier off that of the housing while the carrier turns, against closed forms.

An offset E of the ring closes the branches sun-planet-ring by the first harmonic E over the
planets, one of the carrier by 2 cos(alpha) E. In the frame of the carrier it turns once with each
turn of the carrier. With held axes the share of a planet swings by K/F of that, K the stiffness of
a branch and F the mean mesh force; a free sun follows, and the shares stay even.
"""

import math

import numpy as np
import pytest
from planar.published_set import MESH, PIN, TORQUE, scene

from planetary_twin_py import simulate
from planetary_twin_py.statics.load_sharing import load_sharing

HELD, FREE, E = 1e14, 0.0, 5e-6
ANGLE = math.radians(21.34)
BRANCH = 1.0 / (2.0 / MESH + 4.0 * math.cos(ANGLE) ** 2 / PIN)
FORCE = TORQUE / (4 * 0.5 * 30 * 0.8e-3 * math.cos(ANGLE))  # of each of four planets [N]
RATIO = 1.0 + 70.0 / 30.0  # turns of the sun per turn of the carrier
SPEED = 100.0  # [rad/s] of the sun
TURN = 2.0 * math.pi * RATIO / SPEED  # [s]
SAMPLES = 256
BY_MEMBER = [("ring", E), ("carrier", 2.0 * math.cos(ANGLE) * E)]
OFFSETS = pytest.mark.parametrize(("member", "approach"), BY_MEMBER)


def turning(member, sun, dynamics, **changes):
    offset = {f"{member}_offset": {"size": E, "angle": 0.4}}
    turned = {"gearset.held": "ring", "drive.output.member": "carrier", "input_speed": SPEED}
    turned |= {"dynamics": dynamics, "lubrication.friction": False, "mesh.ramp": 0.0}
    return scene(4, offset, sun, **turned, **changes)


def one_turn(given, settling=0.0):
    return simulate(given, TURN, sample_rate=SAMPLES / TURN, settling=settling)


def orders(samples):
    """Amplitudes by cycles in a turn of the carrier, (orders, ...)."""
    return 2.0 * np.abs(np.fft.rfft(samples, axis=0)) / len(samples)


@OFFSETS
def test_with_held_axes_shares_swing_once_in_turn_of_the_carrier(member, approach):
    shares = orders(one_turn(turning(member, HELD, "quasi_static_planar")).axes.load_share)
    assert shares[1] == pytest.approx(BRANCH * approach / FORCE, rel=1e-4)
    assert shares[2:] == pytest.approx(0.0, abs=1e-6)


@OFFSETS
def test_a_free_sun_follows_and_shares_stay_even(member, approach):
    axes = one_turn(turning(member, FREE, "quasi_static_planar")).axes
    assert axes.load_share == pytest.approx(1.0, abs=1e-5)  # swings by 0.08 and 0.15 if held
    along = orders(axes.displacement[:, 0])
    assert along[1] == pytest.approx(approach, rel=1e-4)


@OFFSETS
@pytest.mark.parametrize("sun", [HELD, FREE], ids=["held", "free"])
def test_loads_and_float_are_those_of_statics(member, approach, sun):
    # But for the angle by which the couplings are wound up.
    given = turning(member, sun, "quasi_static_planar")
    run = one_turn(given)
    static = load_sharing(given, run.time * SPEED / (2.0 * math.pi))
    assert orders(run.axes.load_share) == pytest.approx(orders(static.share), abs=1e-5)
    floated, expected = (orders(each.displacement[:, 0]) for each in (run.axes, static))
    assert floated[1] == pytest.approx(expected[1], abs=1e-3 * E)
