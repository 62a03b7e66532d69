"""Speeds against Willis' relations and against the numbers of the paper's gearset."""

import math
from fractions import Fraction
from itertools import permutations

import pytest

from planetary_twin_py.gearset.kinematics import (
    MEMBERS,
    Teeth,
    mesh_cycles_per_turn,
    mesh_frequency,
    speed_ratios,
    speeds_per_input,
)

PAPER = Teeth(30, 20, 70)
PAIRS = list(permutations(MEMBERS, 2))


@pytest.mark.parametrize("held, reference", PAIRS)
@pytest.mark.parametrize("teeth", [PAPER, Teeth(21, 39, 99)])
def test_pitch_lines_roll_without_slip_whichever_member_is_held(teeth, held, reference):
    w = speed_ratios(teeth, held, reference)
    zs, zp, zr = teeth
    assert w[held] == 0 and w[reference] == 1
    assert zs * (w["sun"] - w["carrier"]) + zp * (w["planet"] - w["carrier"]) == 0
    assert zp * (w["planet"] - w["carrier"]) == zr * (w["ring"] - w["carrier"])
    assert (zr + zs) * w["carrier"] == zr * w["ring"] + zs * w["sun"]


@pytest.mark.parametrize(
    "held, reference, frequency",
    [("carrier", "sun", 500), ("ring", "sun", 350), ("sun", "carrier", 500), ("sun", "ring", 350)],
)
def test_meshing_frequency_at_1000_rpm(held, reference, frequency):
    ratios = speed_ratios(PAPER, held, reference)
    assert abs(mesh_cycles_per_turn(PAPER, ratios)) * Fraction(1000, 60) == frequency


def test_speeds_of_a_differential_are_those_of_both_inputs():
    """1000 rpm at the sun and 500 at the carrier: ring 285.71 rpm, 250 Hz; equal: no meshing."""
    sun, carrier = speeds_per_input(PAPER, ("sun", "carrier"), "none")
    both = {body: 1000 * sun[body] + 500 * carrier[body] for body in sun}
    assert (both["sun"], both["carrier"], both["ring"]) == (1000, 500, Fraction(2000, 7))
    assert mesh_cycles_per_turn(PAPER, both) / 60 == 250
    equal = {body: sun[body] + carrier[body] for body in sun}
    assert set(equal.values()) == {1}
    assert mesh_cycles_per_turn(PAPER, equal) == 0


@pytest.mark.parametrize("held, reference", [("sun", "sun"), ("planet", "sun"), ("ring", "")])
def test_a_member_cannot_be_held_and_turn_and_must_be_central(held, reference):
    with pytest.raises(ValueError, match="two of"):
        speed_ratios(PAPER, held, reference)


def test_teeth_pass_as_often_as_sun_turns_against_the_carrier():
    turn = 2 * math.pi
    assert mesh_frequency(PAPER, 1000 / 60 * turn, 0.0) == pytest.approx(500.0)
    assert mesh_frequency(PAPER, -2 * turn, 3 * turn) == pytest.approx(150.0)
    assert mesh_frequency(PAPER, 7.0, 7.0) == 0.0
