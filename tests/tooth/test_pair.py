"""A pair of teeth along its path: scaling, symmetry, faults, and the band of ISO 6336."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tooth.pairs import planet_ring_pair, sun_planet_pair

from planetary_twin_py.gearset.involute import SpurGear
from planetary_twin_py.gearset.kinematics import Teeth
from planetary_twin_py.tooth.contact import weber_banaschek, yang_sun
from planetary_twin_py.tooth.crack import Crack
from planetary_twin_py.tooth.iso import IsoPair
from planetary_twin_py.tooth.material import Material
from planetary_twin_py.tooth.spall import Spall
from planetary_twin_py.tooth.tooth import Tooth

STEEL = Material(206e9, 0.3)
PAPER, MODULE, ALPHA, WIDTH = Teeth(30, 20, 70), 0.8e-3, math.radians(21.34), 0.02
LINE_LOAD = 94e3  # N/m: 63 N m over three planets at 20 mm
MESHES = pytest.mark.parametrize("mesh", [sun_planet_pair, planet_ring_pair])


def pair_of(mesh, teeth=PAPER, module=MODULE, material=STEEL, line_load=LINE_LOAD):
    return mesh(teeth, module, ALPHA, 1.0, material, weber_banaschek(line_load))


def path_of(pair, points=101):
    return np.linspace(-pair.path.approach, pair.path.recess, points)


@MESHES
def test_stiffness_is_proportional_to_face_width_and_modulus(mesh):
    pair = mesh(PAPER, MODULE, ALPHA, 1.0, STEEL, yang_sun)
    soft = mesh(PAPER, MODULE, ALPHA, 1.0, Material(103e9, 0.3), yang_sun)
    position = path_of(pair)
    assert pair.stiffness(position, 0.04) == pytest.approx(2 * pair.stiffness(position, WIDTH))
    assert soft.stiffness(position, WIDTH) == pytest.approx(0.5 * pair.stiffness(position, WIDTH))


@MESHES
def test_stiffness_per_face_width_does_not_depend_on_the_module(mesh):
    """At equal line load per module, which leaves the shape of the contact as it is."""
    small = pair_of(mesh)
    large = pair_of(mesh, module=10 * MODULE, line_load=10 * LINE_LOAD)
    position = path_of(small)
    assert large.stiffness(position, WIDTH) == pytest.approx(small.stiffness(position, WIDTH))


def test_swapping_the_gears_turns_the_path_around():
    there, back = (pair_of(sun_planet_pair, Teeth(*z)) for z in [(30, 20, 70), (20, 30, 80)])
    position = path_of(there)
    assert back.stiffness(-position, WIDTH) == pytest.approx(there.stiffness(position, WIDTH))


def test_equal_gears_are_symmetric_about_the_pitch_point():
    pair = pair_of(sun_planet_pair, Teeth(30, 30, 90))
    position = path_of(pair)
    stiffness = pair.stiffness(position, WIDTH)
    assert stiffness == pytest.approx(stiffness[::-1], rel=1e-9)
    assert position[np.argmax(stiffness)] == pytest.approx(0.0, abs=1e-9)


@MESHES
def test_stiffness_is_continuous_and_has_one_hump(mesh):
    pair = pair_of(mesh)
    stiffness = pair.stiffness(path_of(pair, 2001), WIDTH)
    assert np.abs(np.diff(stiffness)).max() < 3e-3 * stiffness.max()
    assert np.count_nonzero(np.diff(np.sign(np.diff(stiffness)))) == 1


@pytest.mark.parametrize("teeth", [(18, 18), (20, 30), (19, 48), (30, 100), (60, 60), (50, 150)])
@pytest.mark.parametrize("alpha", [20.0, 21.34])
def test_external_pair_lies_in_the_band_of_iso_6336(teeth, alpha):
    """Theory beside theory, c'_th C_B; the c' that ISO rates with is C_M = 0.8 of it."""
    angle = math.radians(alpha)
    pair = sun_planet_pair(
        Teeth(*teeth, 0), MODULE, angle, 1.0, STEEL, weber_banaschek(300e6 * MODULE)
    )
    iso = IsoPair(teeth, angle)
    largest = pair.stiffness(path_of(pair), 1.0).max()
    assert 0.80 < largest / (iso.theoretical * iso.basic_rack_factor) < 1.0


def test_mean_of_the_coupled_mesh_is_that_of_iso_6336():
    """c_gamma,alpha of the paper's sun and planet, teeth on shared bodies included."""
    pair = pair_of(sun_planet_pair)
    ratio = pair.path.contact_ratio
    low, high = -pair.path.approach, pair.path.recess
    double = pair.double_contact_stiffness(np.linspace(low, high - 1, 101), 1.0).mean()
    single = pair.stiffness(np.linspace(high - 1, low + 1, 101), 1.0).mean()
    mean = (ratio - 1) * double + (2 - ratio) * single
    assert mean == pytest.approx(IsoPair((20, 30), ALPHA).mesh(STEEL, ratio), rel=0.05)


@MESHES
def test_two_pairs_on_shared_bodies_are_less_than_twice_as_stiff(mesh):
    pair = pair_of(mesh)
    assert 0.80 < pair.shared_body_factor < 0.90
    stiff_hub = replace(pair, first=replace(pair.first, held=0.95))
    assert stiff_hub.shared_body_factor > pair.shared_body_factor


@MESHES
def test_a_deeper_crack_is_softer_and_depth_zero_is_none(mesh):
    healthy = pair_of(mesh)
    position = path_of(healthy)
    before = healthy.stiffness(position, WIDTH)
    for share in (0.0, 0.1, 0.2, 0.3, 0.4, 0.5):
        crack = Crack(share * MODULE * 1.5)
        after = replace(healthy, first=replace(healthy.first, crack=crack)).stiffness(
            position, WIDTH
        )
        if share == 0.0:
            assert after == pytest.approx(before, rel=1e-14)
        else:
            assert np.all(after <= before) and after.min() < 0.999 * before.min()
        before = after


def test_a_crack_has_the_largest_effect_at_the_tip():
    """The cracked sun tooth drives and leaves the mesh at its tip, at the end of the path."""
    pair = pair_of(sun_planet_pair)
    cracked = replace(pair, first=replace(pair.first, crack=Crack(0.4 * MODULE)))
    position = path_of(pair)
    left = cracked.stiffness(position, WIDTH) / pair.stiffness(position, WIDTH)
    assert np.all(np.diff(left) < 1e-12) and left[-1] < 0.95 < 0.99 < left[0]


def test_crack_past_the_centre_line_is_refused_in_one_line():
    pair = pair_of(sun_planet_pair)
    broken = replace(pair.first, crack=Crack(MODULE * 2))
    with pytest.raises(ValueError, match=r"depth of crack = 0.0016 m: must be within 0 and"):
        broken.beam(np.array([pair.first.gear.pitch_radius]))


@MESHES
def test_spall_softens_only_its_stretch_and_more_the_wider_it_is(mesh):
    healthy = pair_of(mesh)
    position = path_of(healthy)
    before = healthy.stiffness(position, WIDTH)
    within = (position >= -0.2) & (position <= 0.1)
    for width in (0.0, 0.2, 0.5, 0.9):
        after = replace(healthy, spall=Spall(-0.2, 0.1, width)).stiffness(position, WIDTH)
        assert after[~within] == pytest.approx(healthy.stiffness(position, WIDTH)[~within])
        assert np.all(after[within] <= before[within])
        assert width == 0.0 or np.all(after[within] < before[within])
        before = after


def test_spall_takes_its_share_of_the_contact_alone():
    """Compliance grows by that of the contact times w/(1 - w)."""
    pair = sun_planet_pair(PAPER, MODULE, ALPHA, 1.0, STEEL, yang_sun)
    spalled = replace(pair, spall=Spall(-1.0, 1.0, 0.5))
    at = np.array([0.1])
    grown = spalled.compliance(at) - pair.compliance(at)
    assert grown == pytest.approx([4 * (1 - 0.3**2) / (math.pi * 206e9)], rel=1e-9)


@given(
    sun=st.integers(18, 120),
    planet=st.integers(18, 120),
    alpha=st.floats(17.0, 25.0),
    addendum=st.floats(0.7, 1.0),
)
@settings(max_examples=60, deadline=None)
def test_any_gearset_has_a_finite_positive_stiffness(sun, planet, alpha, addendum):
    teeth, angle = Teeth(sun, planet, sun + 2 * planet), math.radians(alpha)
    for mesh in (sun_planet_pair, planet_ring_pair):
        try:
            pair = mesh(teeth, MODULE, angle, addendum, STEEL, weber_banaschek(LINE_LOAD))
        except ValueError as error:
            assert "tip" in str(error)
            continue
        stiffness = pair.stiffness(path_of(pair), 1.0)
        assert stiffness.min() > 5e9 and stiffness.max() < 30e9


def test_interference_and_a_wrong_body_are_refused_in_one_line():
    with pytest.raises(ValueError, match=r"teeth\.sun = 12: tips of the planets reach below"):
        pair_of(sun_planet_pair, Teeth(12, 60, 132))
    gear = SpurGear(30, MODULE, ALPHA)
    for held in (-0.5, 0.0, 1.0, 1.2):
        with pytest.raises(ValueError, match=rf"held = {held:g} root radii: must be within 0 and"):
            Tooth(gear, STEEL, held)
