"""The wind turbine stage against the published figures of its gears, drivetrain and friction."""

import math

import pytest

import planetary_twin_py as pt
from planetary_twin_py.explanation.meshes import describe_meshes
from planetary_twin_py.gearset.geometry import pitch_radius

SCENE = pt.load_scene("wind_turbine_stage")
SIDES = {"sun_planet": slice(0, 3), "planet_ring": slice(3, 6)}


@pytest.mark.parametrize("gear, diameter", [("sun", 556.68), ("planet", 1033.8), ("ring", 2624.3)])
def test_pitch_diameters_are_the_published_ones(gear, diameter):
    """Dabrowski and Natarajan, in mm."""
    teeth = getattr(SCENE.gearset.teeth, gear)
    found = 2e3 * pitch_radius(teeth, SCENE.gearset.module)
    assert found == pytest.approx(diameter, abs=0.05)


def test_equivalent_masses_are_the_published_moments_of_inertia():
    """64.9, 334.4, 14685, 7452 kg m^2 over the squares of the published pitch radii."""
    sun, planet, ring = 0.55668 / 2, 1.0338 / 2, 2.6243 / 2
    masses = SCENE.gearset.equivalent_mass
    for name, inertia, radius in (
        ("sun", 64.9, sun), ("planet", 334.4, planet), ("ring", 14685.0, ring),
        ("carrier", 7452.0, sun + planet),
    ):  # fmt: skip
        assert getattr(masses, name) == pytest.approx(inertia / radius**2, rel=2e-4)


def test_first_mode_is_that_on_the_published_spring():
    """2.22 Hz, NREL 5 MW reference turbine: 3.876e7 and 97^2 534.1 kg m^2 on 8.676e8 N m/rad."""
    rotor, generator, spring = 3.8759236e7, 97.0**2 * 534.116, 8.67637e8
    published = math.sqrt(spring * (1 / rotor + 1 / generator)) / (2 * math.pi)
    assert published == pytest.approx(2.22, abs=0.005)
    found = pt.natural_modes(SCENE, "machines").frequencies
    assert found[0] == pytest.approx(0.0, abs=1e-6)
    assert found[1] == pytest.approx(published, rel=5e-3)


def loss_coefficients(traction):
    """Mean friction coefficient by its definition, loss = mu H_v power of the mesh, and losses [W].

    For both kinds of mesh, without vibration.
    """
    scene = SCENE.replace(**{"dynamics": "quasi_static", "lubrication.traction": traction})
    meshes = describe_meshes(scene)
    run = pt.simulate(scene, 4.0 / meshes.mesh_frequency, 400 * meshes.mesh_frequency)
    teeth = SCENE.gearset.teeth
    pitch_line = meshes.mesh_frequency * math.pi * SCENE.gearset.module
    power = pitch_line * math.cos(SCENE.gearset.pressure_angle)  # of a mesh, over its force
    assert teeth.ring == teeth.sun + 2 * teeth.planet
    found = {}
    for kind, (side, which) in enumerate(SIDES.items()):
        loss = run.power_loss[:, which].sum(axis=1).mean()
        passed = abs(run.mesh_force[:, which].mean()) * 3 * power
        found[side] = loss / (passed * meshes[1 + kind].loss_factor), loss
    return found


def schlenk_at_the_pitch_point(first, second):
    """The printed formula, with the whole force of a mesh in N/mm, m/s, mm, mPa s and um."""
    gears, oil = SCENE.gearset, SCENE.lubrication
    sine = math.sin(gears.pressure_angle)
    line = describe_meshes(SCENE).sun_planet.static_force / (1e3 * gears.face_width)
    speed = 2 * describe_meshes(SCENE).mesh_frequency * math.pi * gears.module * sine
    radius = 1e3 * gears.module / 2 * sine / (1 / first + 1 / second)
    roughness = 1e6 * oil.composite_roughness / math.sqrt(math.pi)
    mu = 0.048 * (line / (speed * radius)) ** 0.2
    return mu * (1e3 * oil.viscosity) ** -0.05 * roughness**0.25


PITCH_POINT = {
    "sun_planet": schlenk_at_the_pitch_point(21, 39),
    "planet_ring": schlenk_at_the_pitch_point(39, -99),
}


def test_the_default_law_is_near_schlenks():
    """At 0.9 GPa in the sun meshes, both apply. At 0.4 GPa in the ring meshes, the film shears
    almost as a Newtonian fluid, for which the regression of loaded test gears has no term."""
    found = loss_coefficients("eyring")
    assert found["sun_planet"][0] == pytest.approx(PITCH_POINT["sun_planet"], rel=0.3)
    assert 0.4 < found["planet_ring"][0] / PITCH_POINT["planet_ring"] < 0.6
    assert found["planet_ring"][1] == pytest.approx(4.06e3, rel=0.02)
