"""Scenes of gear sets with profile shift: what is accepted, what is refused, moments of inertia."""

import math

import pytest

import planetary_twin_py as pt
from planetary_twin_py.scene.load import parse_scene

PAPER = pt.load_scene("paper")
STAGE = pt.load_scene("reference_gearbox_stage")
THIRDS = ["0 deg", "120 deg", "240 deg"]


def gear_set(sun, planet, ring, angles=THIRDS, **fields):
    """A scene with these teeth; other fields of the gearset by name."""
    names = {"teeth": {"sun": sun, "planet": planet, "ring": ring}, "planet_angles": angles}
    names |= {"module": "1 mm", "pressure_angle": "20 deg"} | fields
    return PAPER.replace(**{f"gearset.{name}": value for name, value in names.items()})


@pytest.mark.parametrize(
    "scene",
    [
        gear_set(31, 31, 95, centre_distance="31.5 mm"),
        gear_set(31, 31, 95, centre_distance="31.5 mm",
                 profile_shift={"sun": 0.26, "planet": 0.25, "ring": -0.2}),
        gear_set(21, 31, 84, profile_shift={"sun": 0.25, "planet": 0.25, "ring": -0.25}),
        gear_set(27, 35, 99, [f"{k * 360 / 126 * 32 - (k > 1) * 360 / 126:.12g} deg"
                              for k in range(3)],
                 profile_shift={"sun": 0.25, "planet": 0.25, "ring": 0.24}),
        STAGE,
    ],
)  # fmt: skip
def test_real_sets_are_accepted(scene):
    gears = scene.gearset.geometry
    sun, ring = gears.meshes
    assert sun.pressure_angle != ring.pressure_angle
    assert all(mesh.path.contact_ratio > 1.1 for mesh in gears.meshes)
    assert all(mesh.backlash > -0.01 * scene.gearset.module for mesh in gears.meshes)


def refusal(**changes):
    with pytest.raises(pt.SceneError) as error:
        STAGE.replace(**{f"gearset.{name}": value for name, value in changes.items()})
    return str(error.value)


@pytest.mark.parametrize(
    "changes, start",
    [
        ({"profile_shift.ring": 0.0}, "gearset: profile_shift.planet + ring = 0.802: must be at"),
        ({"profile_shift.sun": 2.5}, "gearset.profile_shift.sun = 2.5: must be a number within"),
        (
            {"tip_diameter.planet": "0.929 m"},
            "gearset: tip_diameter.planet = 929 mm: must be below",
        ),
        ({"tip_diameter.sun": "0.7 m"}, "gearset: "),
        ({"tip_diameter.sun": "2 m"}, "gearset: teeth.sun = 19: the tooth is pointed below its"),
        ({"tip_diameter.ring": "2.3 m"}, "gearset: teeth.ring = 56: the ring's tips are inside"),
    ],
)
def test_what_does_not_fit_is_refused_with_field_value_and_range(changes, start):
    message = refusal(**changes).splitlines()[-1].strip()
    assert message.startswith(start)


def test_without_shift_or_centre_distance_sets_must_be_coaxial():
    with pytest.raises(pt.SceneError, match=r"31/31/95: standard gears .* = 93; other gears"):
        gear_set(31, 31, 95)


def test_planets_are_kept_apart_by_distance_and_tips():
    gears = STAGE.gearset.geometry
    step = 360.0 / 75
    near = [f"{90 + step * k} deg" for k in (0, 12, 50)]
    apart = 2.0 * gears.centre_distance * math.sin(math.radians(0.5 * 12 * step))
    assert apart < 2.0 * gears.planet.tip_radius
    with pytest.raises(pt.SceneError, match=f"distance of planets 1 and 2 is {1e3 * apart:.4g}"):
        STAGE.replace(**{"gearset.planet_angles": near})


def test_inertias_are_equivalent_masses_times_r_squared():
    gearset = PAPER.gearset
    radii = {
        name: 0.5 * gearset.module * teeth
        for name, teeth in gearset.tooth_numbers._asdict().items()
    } | {"carrier": 0.5 * gearset.module * (gearset.teeth.sun + gearset.teeth.planet)}
    inertia = {name: getattr(gearset.equivalent_mass, name) * r**2 for name, r in radii.items()}
    scene = PAPER.replace(**{"gearset.inertia": inertia, "gearset.equivalent_mass": None})
    for name in radii:
        found = getattr(scene.gearset.rim_masses, name)
        assert found == pytest.approx(getattr(gearset.equivalent_mass, name), rel=1e-12)
    assert scene.gearset.equivalent_mass is None


def test_a_scene_on_a_base_may_give_inertia_instead_of_mass():
    scene = parse_scene(
        "{base: paper, gearset: {inertia: {sun: 1e-4 kg m^2, planet: 1e-5 kg m^2, "
        "ring: 1e-3 kg m^2, carrier: 1e-3 kg m^2}}}"
    )
    assert scene.gearset.rim_masses.sun == pytest.approx(1e-4 / 0.012**2)


def test_both_forms_of_inertia_or_none_are_refused():
    four = dict.fromkeys(("sun", "planet", "ring", "carrier"), 1e-3)
    for changes, why in (
        ({"gearset.inertia": four}, "given twice"),
        ({"gearset.equivalent_mass": None}, "missing"),
    ):
        with pytest.raises(pt.SceneError, match=f"equivalent_mass, inertia: {why}"):
            PAPER.replace(**changes)
