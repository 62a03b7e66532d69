"""Form factors against the printed figures of a commercial program, and limits."""

import math

import pytest

from planetary_twin_py.durability.root_form import (
    outer_single_contact,
    root_factors,
    root_section,
)
from planetary_twin_py.gearset.involute import SpurGear

# Stage 1 of the NREL 5 MW reference gearbox, KISSsoft 03/2017, report of 26.02.2020 in the
# repository gfsReboucas/Drivetrain (@NREL_5MW/stage_01.rtf): teeth, x, d_a [mm], and what it prints
# of h_Fe, s_Fn, rho_F [mm], Y_F, Y_S, sigma_F0 [N/mm^2].
MODULE, WIDTH, FORCE = 0.045, 0.491, 829_478.6 * math.cos(math.radians(20.0))
PRINTED = [
    (19, 0.6170, 978.808, (64.83, 101.18, 18.12, 1.56, 2.06, 113.46)),
    (17, 0.8021, 905.470, (65.24, 104.13, 17.19, 1.44, 2.14, 108.94)),
]


def gear(teeth, shift, tip_diameter=None, fillet=0.38):
    height = 1.0 if tip_diameter is None else 0.5 * (tip_diameter / 45.0 - teeth) - shift
    angle = math.radians(20.0)
    return SpurGear(teeth, MODULE, angle, addendum=height, profile_shift=shift, fillet=fillet)


@pytest.mark.parametrize(("teeth", "shift", "tip", "printed"), PRINTED)
def test_factors_are_those_that_a_commercial_program_prints(teeth, shift, tip, printed):
    wheel = gear(teeth, shift, tip)
    factors = root_factors(wheel, outer_single_contact(wheel, 1.1148))
    section = root_section(wheel)
    lengths = [45.0 * value for value in (factors.arm, section.thickness, section.curvature)]
    arm, thickness, curvature, form, correction, stress = printed
    assert lengths == pytest.approx([arm, thickness, curvature], abs=0.0051)
    assert [factors.form, factors.correction] == pytest.approx([form, correction], abs=0.0051)
    assert factors.stress(FORCE, WIDTH, MODULE) / 1e6 == pytest.approx(stress, abs=0.02)


def test_a_rack_has_the_section_of_its_straight_tooth():
    """Infinitely many teeth: the 30 degree tangent of the fillet follows from the rack alone."""
    section, x = root_section(gear(1e7, 0.0)), math.radians(20.0)
    centre = math.pi / 4 + 1.25 * math.tan(x) + 0.38 * (1 - math.sin(x)) / math.cos(x)  # from axis
    assert section.thickness / 2 == pytest.approx(centre - 0.38 * math.cos(math.pi / 6), rel=1e-5)
    assert section.curvature == pytest.approx(0.38, rel=1e-5)


def test_bending_grows_from_the_root_to_the_tip():
    wheel = gear(30, 0.0)
    radii = [wheel.base_radius + part * (wheel.tip_radius - wheel.base_radius) for part in (0.6, 1)]
    inner, outer = (root_factors(wheel, radius) for radius in radii)
    assert outer.form > inner.form
    assert outer.arm > inner.arm


def test_a_sharper_fillet_concentrates_more_stress():
    sharp, round_ = gear(30, 0.0, fillet=0.2), gear(30, 0.0, fillet=0.38)
    corrections = [root_factors(wheel, wheel.tip_radius).correction for wheel in (sharp, round_)]
    assert corrections[0] > corrections[1]


def test_what_the_factors_do_not_cover_is_refused():
    ring = SpurGear(56, MODULE, math.radians(20.0), internal=True)
    with pytest.raises(ValueError, match=r"^internal = True: the form factors are those of"):
        root_section(ring)
    with pytest.raises(ValueError, match=r"^radius = 0.1 m: must be within 0\.63"):
        root_factors(gear(30, 0.0), 0.1)
