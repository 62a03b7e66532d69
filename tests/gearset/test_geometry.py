"""Paths of contact against the numbers of the paper's gearset."""

import math

import pytest

from planetary_twin_py.gearset.geometry import base_pitch, planet_ring_path, sun_planet_path
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
