"""Root fillets against a rack that is rolled over the gear by brute force, and by their touch."""

import math
from itertools import pairwise

import numpy as np
import pytest

from planetary_twin_py.gearset.involute import TIP_ROUNDING, SpurGear
from planetary_twin_py.tooth.fillet import fillet
from planetary_twin_py.tooth.profile import POINTS, ToothProfile

ALPHA = math.radians(21.34)
EXTERNAL = [SpurGear(z, 1.0, ALPHA) for z in (12, 20, 30, 60)]
INTERNAL = [SpurGear(z, 1.0, ALPHA, internal=True) for z in (40, 70, 150)]


def rack_in_gear(gear, rolled):
    """Right corner of the rack's tooth, in the frame of the gear whose gap is on the y axis."""
    centre = 1.25 - TIP_ROUNDING
    offset = math.pi / 4 - centre * math.tan(ALPHA) - TIP_ROUNDING / math.cos(ALPHA)
    round_tip = np.linspace(-math.pi / 2, -ALPHA, 200)
    straight = np.linspace(0.0, 2.6, 500)[1:] * np.exp(1j * (math.pi / 2 - ALPHA))
    tip = TIP_ROUNDING * np.exp(1j * round_tip)
    corner = np.concatenate([tip, tip[-1] + straight])
    at = offset + rolled + corner + 1j * (gear.pitch_radius - centre)
    return at * np.exp(1j * rolled / gear.pitch_radius)


@pytest.mark.parametrize("gear", EXTERNAL, ids=lambda g: g.teeth)
def test_external_outline_is_the_envelope_of_a_rolling_rack(gear):
    """No point of it ever enters the tooth, and at every radius some point touches it."""
    cut = rack_in_gear(gear, np.linspace(-4.0, 4.0, 4001)[:, None]).ravel()
    cut = cut[(np.abs(cut) > gear.root_radius) & (np.abs(cut) < gear.tip_radius)]
    radius, from_gap = np.abs(cut), math.pi / 2 - np.angle(cut)
    start = ToothProfile(gear).flank_start
    on_fillet = np.interp(radius, *fillet(gear)(np.linspace(0.0, 1.0, 5000)))
    half = np.where(radius < start, on_fillet, gear.half_thickness(radius))
    room = radius * (math.pi / gear.teeth - half - from_gap)
    assert room.min() > -1e-5
    edges = np.linspace(gear.root_radius, gear.tip_radius, 41)
    for low, high in pairwise(edges):
        assert room[(low <= radius) & (radius < high)].min() < 1e-4


@pytest.mark.parametrize("gear", EXTERNAL[1:] + INTERNAL, ids=lambda g: g.teeth)
def test_fillet_touches_the_flank_and_the_root_circle(gear):
    t = np.linspace(0.0, 1.0, 20001)
    radius, half = fillet(gear)(t)
    at = radius * np.exp(1j * half)
    assert radius[0] == pytest.approx(gear.root_radius, rel=1e-12)
    assert half[-1] == pytest.approx(float(gear.half_thickness(radius[-1:])[0]), rel=1e-9)
    into_flank = np.angle((at[-1] - at[-2]) * np.exp(-1j * half[-1]))
    further = radius[-1] + np.sign(gear.tip_radius - radius[-1]) * np.array([0.0, 1e-5])
    flank = further * np.exp(1j * gear.half_thickness(further))
    along_flank = np.angle((flank[1] - flank[0]) * np.exp(-1j * half[-1]))
    assert into_flank == pytest.approx(along_flank, abs=1e-3)
    from_root = (at[1] - at[0]) * np.exp(-1j * half[0])
    assert abs(from_root.real) < 1e-3 * abs(from_root.imag)


@pytest.mark.parametrize("gear", INTERNAL, ids=lambda g: g.teeth)
def test_internal_fillet_is_an_arc_of_the_rack_or_the_bottom(gear):
    radius, half = fillet(gear)(np.linspace(0.0, 1.0, 5))
    at = radius * np.exp(1j * half)
    first, second, third = at[0], at[2], at[4]
    sides = abs(second - first) * abs(third - second) * abs(first - third)
    area = 0.5 * abs(((second - first).conjugate() * (third - first)).imag)
    curvature = sides / (4 * area)
    if half[0] < math.pi / gear.teeth - 1e-9:
        assert curvature == pytest.approx(TIP_ROUNDING, rel=1e-9)
    else:
        assert half[0] == pytest.approx(math.pi / gear.teeth, rel=1e-9)
        assert 0.3 < curvature < TIP_ROUNDING


ANY = [
    (alpha, teeth, internal)
    for alpha in (14.5, 17.0, 20.0, 25.0)
    for teeth in (8, 12, 17, 25, 32, 41, 42, 100, 300)
    for internal in (False, True)
    if not internal or teeth * (1 - math.cos(math.radians(alpha))) > 2  # tips outside the base
]


@pytest.mark.parametrize(("alpha", "teeth", "internal"), ANY)
def test_outline_rises_without_a_jump(alpha, teeth, internal):
    profile = ToothProfile(SpurGear(teeth, 1.0, math.radians(alpha), internal=internal))
    height, half = profile.outline
    assert np.all(np.diff(height) >= 0) and half.min() > 0
    assert abs(half[POINTS] - half[POINTS - 1]) < 0.05
    assert 0 < profile.critical_height < height[POINTS - 1]


def test_gears_without_room_for_a_root_are_refused_in_one_line():
    with pytest.raises(ValueError, match=r"pressure_angle = 33 deg: the rack tooth"):
        fillet(SpurGear(40, 1.0, math.radians(33)))
    with pytest.raises(ValueError, match=r"pressure_angle = 30 deg: the flanks of a gear with 30"):
        fillet(SpurGear(30, 1.0, math.radians(30), internal=True))
