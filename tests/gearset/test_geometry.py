"""Paths of contact against the numbers of the paper's gearset."""

import math

import pytest
from paths import planet_ring_path, sun_planet_path

from planetary_twin_py.gearset.geometry import base_pitch
from planetary_twin_py.gearset.kinematics import Teeth

PAPER, ANGLE = Teeth(30, 20, 70), math.radians(21.34)
ROUNDED = {"abs": 0.6e-4}


def test_base_pitch():
    assert base_pitch(0.8e-3, ANGLE) == pytest.approx(2.34096e-3, rel=1e-5)


def test_external_contact():
    path = sun_planet_path(PAPER, ANGLE, 1.0)
    assert path == pytest.approx((0.7562, 0.7992), **ROUNDED)
    assert path.contact_ratio == pytest.approx(1.5554, **ROUNDED)


def test_internal_contact():
    path = planet_ring_path(PAPER, ANGLE, 1.0)
    assert path == pytest.approx((1.0531, 0.7562), **ROUNDED)
    assert path.contact_ratio == pytest.approx(1.8092, **ROUNDED)


def test_contact_ratios_at_twenty_degrees():
    paths = [f(PAPER, math.radians(20), 1.0) for f in (sun_planet_path, planet_ring_path)]
    assert [p.contact_ratio for p in paths] == pytest.approx([1.6052, 1.9136], **ROUNDED)


def test_a_ring_without_flanks_at_its_tip_is_refused():
    with pytest.raises(ValueError, match="inside its base circle"):
        planet_ring_path(Teeth(12, 12, 36), math.radians(20), 1.2)


@pytest.mark.parametrize("addendum", [0.8, 1.0, 1.2])
@pytest.mark.parametrize("angle", [20.0, 25.0])
def test_a_pinion_needs_enough_teeth_to_avoid_interference(angle, addendum):
    """The least number by the closed form of Buckingham (1949), ch. 4, for a gear of 40 teeth."""
    sine, mate = math.sin(math.radians(angle)), 40
    square = mate**2 + 4.0 * addendum * (mate + addendum) / sine**2
    least = math.ceil(math.sqrt(square) - mate)
    sun_planet_path(Teeth(mate, least, mate + 2 * least), math.radians(angle), addendum)
    with pytest.raises(ValueError, match=f"^gearset.teeth.planet = {least - 1}: tips of the sun"):
        sun_planet_path(Teeth(mate, least - 1, mate), math.radians(angle), addendum)


def test_ring_tips_must_not_reach_below_the_base_circle():
    planet_ring_path(Teeth(44, 17, 78), ANGLE, 1.0)
    with pytest.raises(ValueError, match=r"^gearset.teeth.planet = 16: tips of the ring"):
        planet_ring_path(Teeth(44, 16, 76), ANGLE, 1.0)
