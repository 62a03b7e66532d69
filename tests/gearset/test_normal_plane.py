"""Gears stated in the normal plane, as drawings do, against formulas and published gears."""

import math

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.gearset.gear_set import Sizes, build_gear_set
from planetary_twin_py.gearset.involute import SpurGear
from planetary_twin_py.gearset.kinematics import Teeth
from planetary_twin_py.gearset.normal_plane import transverse_angle, transverse_sizes, virtual_gear
from planetary_twin_py.gearset.shift import PerGear
from planetary_twin_py.tooth.iso import iso_pair
from planetary_twin_py.tooth.material import Material
from planetary_twin_py.tooth.undercut import least_shift

PAPER = pt.load_scene("paper")
TWENTY = math.radians(20.0)
M = 8e-3
PLANE = {
    "gearset.module": None,
    "gearset.pressure_angle": None,
    "gearset.normal_module": M,
    "gearset.normal_pressure_angle": TWENTY,
}
DRAWN = PLANE | {
    "gearset.teeth": {"sun": 30, "planet": 25, "ring": 80},
    "gearset.planet_angles": [math.pi * n / 55 for n in (0, 37, 73)],
    "gearset.face_width": 0.1,
}
HELICES = pytest.mark.parametrize("degrees", [0.0, 8.0, -20.0, 35.0])


def drawn(degrees, **changes):
    return PAPER.replace(**DRAWN | {"gearset.helix_angle": math.radians(degrees)} | changes)


@HELICES
@pytest.mark.parametrize("dedendum", [1.25, 1.4])
def test_tip_and_root_diameters_are_those_of_the_textbook(degrees, dedendum):
    """d = z m_n/cos(beta), d_a = d + 2 m_n (h_aP + x), d_f = d - 2 m_n (h_fP - x); at the ring
    outwards is inwards. The tips keep h_fP - h_aP from the mating roots."""
    shift = {"sun": -0.1, "planet": 0.1, "ring": -0.1}
    fields = {"gearset.dedendum": dedendum, "gearset.profile_shift": shift}
    gearset = drawn(degrees, **fields).gearset
    for name, gear in zip(shift, (gearset.geometry.sun, gearset.geometry.planet,
                                  gearset.geometry.ring), strict=True):  # fmt: skip
        outwards = -1.0 if gear.internal else 1.0
        reference = getattr(gearset.teeth, name) * M / math.cos(math.radians(degrees))
        tip = reference + outwards * 2.0 * M * (1.0 + shift[name])
        root = reference - outwards * 2.0 * M * (dedendum - shift[name])
        assert 2.0 * gear.tip_radius == pytest.approx(tip, rel=1e-12)
        assert 2.0 * gear.root_radius == pytest.approx(root, rel=1e-12)
    for mesh in gearset.geometry.meshes:
        assert mesh.tip_clearances == pytest.approx([(dedendum - 1.0) * M] * 2, rel=1e-9)


@HELICES
def test_the_transverse_plane_states_the_same_gears(degrees):
    normal, cosine = drawn(degrees), math.cos(math.radians(degrees))
    transverse = {
        "gearset.normal_module": None,
        "gearset.normal_pressure_angle": None,
        "gearset.module": M / cosine,
        "gearset.pressure_angle": math.atan(math.tan(TWENTY) / cosine),
        "gearset.addendum": cosine,
        "gearset.dedendum": 1.25 * cosine,
    }
    for mesh, same in zip(
        normal.gearset.geometry.meshes,
        normal.replace(**transverse).gearset.geometry.meshes,
        strict=True,
    ):
        assert mesh.path == pytest.approx(same.path, rel=1e-12)
        assert mesh.tip_clearances == pytest.approx(same.tip_clearances, rel=1e-9)


def test_published_virtual_tooth_numbers():
    """ISO/TR 6336-30, example 1: 17 and 103 teeth, m_n 8 mm, 15.8 deg: 18.905 and 114.543."""
    helix = math.radians(15.8)
    for teeth, virtual in ((17, 18.905), (103, 114.543)):
        gear = SpurGear(teeth, M / math.cos(helix), transverse_angle(TWENTY, helix))
        found = virtual_gear(gear, helix)
        assert found.teeth == pytest.approx(virtual, abs=1e-3)
        assert found.module == pytest.approx(M) and found.pressure_angle == pytest.approx(TWENTY)


def test_published_contact_ratio_and_stiffness():
    """The same example with x = 0.145/0, rack D and a = 500 mm. KISSsoft has c' 12.37047 and
    c_gamma 17.46485 N/(mm um), so the contact ratio is (c_gamma/c' - 0.25)/0.75 = 1.5491."""
    shift = PerGear(0.145, 0.0, -0.145)  # of a ring that does not touch the planets' tips
    drawing = Sizes(Teeth(17, 103, 223), M, TWENTY, 1.0, shift, 0.5, dedendum=1.4, fillet=0.39)
    mesh = build_gear_set(transverse_sizes(drawing, math.radians(15.8))).meshes[0]
    assert mesh.path.contact_ratio == pytest.approx(1.5491, rel=1e-3)
    stiffness = iso_pair(mesh, math.radians(15.8)).mesh(
        Material(206e9, 0.3), mesh.path.contact_ratio
    )
    assert stiffness == pytest.approx(17.46485e9, rel=1e-3)


@HELICES
@pytest.mark.parametrize("name", ["sun", "planet", "ring"])
def test_virtual_gear_is_rack_of_drawing_with_curvature_of_flank(degrees, name):
    """rho_n = rho_t/cos(beta_b) at the tip, with sin(beta_b) = sin(beta) cos(alpha_n)."""
    fields = {"gearset.dedendum": 1.4, "gearset.fillet_radius": 0.3}
    gear = getattr(drawn(degrees, **fields).gearset.geometry, name)
    virtual = virtual_gear(gear, math.radians(degrees))
    assert (virtual.addendum, virtual.dedendum, virtual.fillet) == pytest.approx((1.0, 1.4, 0.3))
    base = math.asin(math.sin(math.radians(degrees)) * math.cos(TWENTY))
    at_tip, of_virtual = (math.sqrt(g.tip_radius**2 - g.base_radius**2) for g in (gear, virtual))
    assert of_virtual == pytest.approx(at_tip / math.cos(base), rel=4e-3)
    thick, thin = (
        2.0 * g.pitch_radius * float(g.half_thickness(np.array(g.pitch_radius)))
        for g in (gear, virtual)
    )
    assert thin == pytest.approx(thick * math.cos(math.radians(degrees)), rel=1e-12)


@pytest.mark.parametrize("degrees", [0.0, 15.0, 30.0])
def test_undercut_starts_at_the_shift_of_the_textbook(degrees):
    """x_min = h_fP - rho_fP (1 - sin(alpha_n)) - z sin^2(alpha_t)/(2 cos(beta)) of normal modules
    (Niemann and Winter 2003)."""
    gear = drawn(degrees).gearset.geometry.planet
    cosine = math.cos(math.radians(degrees))
    transverse = math.atan(math.tan(TWENTY) / cosine)
    expected = 1.25 - 0.38 * (1.0 - math.sin(TWENTY))
    expected -= 25 * math.sin(transverse) ** 2 / (2.0 * cosine)
    assert least_shift(gear) / gear.stated == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize(
    "given, line",
    [
        ({"gearset.normal_module": M}, "module, pressure_angle, normal_module: given together"),
        (PLANE | {"gearset.pressure_angle": 0.35}, "pressure_angle, normal_module, normal_press"),
        (PLANE | {"gearset.normal_pressure_angle": None}, "normal_pressure_angle: missing"),
        ({"gearset.module": None}, "module: missing"),
        ({"gearset.addendum": 1.3}, "tip_diameter.sun = 26.08 mm: must be below 26 mm"),
        (DRAWN | {"gearset.fillet_radius": 0.5}, "fillet_radius = 0.5: must be at most 0.4719"),
        (DRAWN | {"gearset.dedendum": 0.9}, "must be below .* mm, where its tips reach the roots"),
    ],
)  # fmt: skip
def test_one_plane_states_the_gears_and_tips_do_not_reach_roots(given, line):
    with pytest.raises(pt.SceneError, match=line):
        PAPER.replace(**given)


def test_messages_state_shifts_in_the_modules_of_the_drawing():
    """x_n of the sun and the planet is too large by the same at any helix angle."""
    cosine = math.cos(math.radians(30.0))
    with pytest.raises(
        pt.SceneError, match=r"profile_shift\.sun \+ planet = 0\.5: must be at most"
    ):
        drawn(30.0, **{
            "gearset.profile_shift": {"sun": 0.3, "planet": 0.2, "ring": -0.7},
            "gearset.centre_distance": 27.5 * M / cosine,
        })  # fmt: skip
