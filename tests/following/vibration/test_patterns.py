"""Lines that name one gear, and gears that share all lines."""

from fractions import Fraction

import pytest
from analysis.gear_sets import gear_set

import planetary_twin_py as pt
from planetary_twin_py.analysis.faults.fault_lines import possible_lines
from planetary_twin_py.following.train import followed_train
from planetary_twin_py.following.vibration.patterns import patterns_of

PAPER = pt.load_scene("paper")


def gears(scene):
    """Orders over the mesh by the gears that a pattern of sidebands names."""
    found = {}
    for pattern in patterns_of(followed_train(scene), None):
        if not pattern.name.startswith("sidebands"):
            continue
        causes = [one.removeprefix("a tooth of the ") for one in pattern.causes]
        named = tuple(one for one in causes if one in ("sun", "planet", "ring"))
        if named:
            found[named] = {line.order for line in pattern.lines}
    return found


def test_each_gear_of_the_paper_has_lines_of_its_own():
    found = gears(PAPER)
    assert set(found) == {("sun",), ("planet",), ("ring",)}
    assert {31 / 30, 29 / 30, 32 / 30} < found["sun",] and 21 / 20 in found["planet",]


def test_sun_and_planet_of_equal_teeth_are_named_together():
    found = gears(gear_set((31, 31, 95)))
    assert ("sun", "planet") in found and not {("sun",), ("planet",)} & set(found)


def test_a_sun_with_lines_at_whole_orders_has_none_of_its_own():
    """21/31/84: four meshes of a tooth per turn of the carrier, as sidebands of passing planets."""
    found = gears(gear_set((21, 31, 84)))
    assert set(found) == {("planet",), ("sun", "planet", "ring")}


def test_gears_that_a_short_hunting_period_does_not_resolve_are_named_together():
    """20/40/100: it is two turns of the carrier long, so lines within one order are one."""
    assert set(gears(gear_set((20, 40, 100)))) == {("sun", "planet", "ring")}


def test_lines_of_a_sun_crack_are_those_of_the_passing_planets():
    """21/39/99: 104.7143 and 101.7143 per turn of the carrier, not 103.7143."""
    orders = {round(99 * order, 4) for order in gears(gear_set((21, 39, 99)))["sun",]}
    assert {104.7143, 101.7143, 110.4286, 107.4286} < orders and 103.7143 not in orders


@pytest.mark.parametrize("teeth", [(21, 39, 99), (28, 36, 100), (17, 37, 91)])
def test_a_line_that_names_one_gear_is_none_of_unequal_planets(teeth):
    scene = gear_set(teeth, 4 if teeth == (28, 36, 100) else 3)
    turning = followed_train(scene).turning
    unequal = turning._replace(symmetry=1)
    for named, orders in gears(scene).items():
        others = {"sun", "planet", "ring"} - set(named)
        for other in others:
            theirs = {float(o / turning.mesh) for o in possible_lines(unequal, other, 3)}
            assert min(abs(a - b) for a in orders for b in theirs) > 1e-9


def test_lines_of_a_bearing_keep_off_those_of_teeth():
    rolling = 14, Fraction(1, 5)
    train = followed_train(gear_set((21, 39, 99)))
    lines = [one for p in patterns_of(train, rolling) if "bearing" in p.name for one in p.lines]
    bins = [line.order * train.hunting_cycles for line in lines]
    steps = [train.hunting_cycles // teeth for teeth in (21, 39, 99)]
    assert lines and min(abs(b - s * round(b / s)) for b in bins for s in steps) >= 2.0
    # 20/40/100: within 1 % of every rate there is a multiple of an order of a tooth
    train = followed_train(gear_set((20, 40, 100)))
    assert all(not p.lines for p in patterns_of(train, rolling) if "bearing" in p.name)
