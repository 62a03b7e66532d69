"""Runs whose axes tilt: limits, symmetries, closed forms and balances."""

import math

import numpy as np
import pytest
from planar.moving_scenes import evenly, planar
from power_flows import FLOWS
from spatial.tilting_scenes import BODIES, spatial

import planetary_twin_py as pt

TILTING = ("axial_displacement", "tilt", "axial_force", "tilting_moment")


def steady(scene, duration=0.02, tolerance=1e-5):
    return pt.simulate(scene, duration, tolerance=tolerance)


@pytest.mark.parametrize("held", [0, 2])
def test_spur_teeth_never_tilt_and_run_as_in_the_plane(held):
    own, other = (
        steady(build(FLOWS[held], **{"errors.planet_thickness": (5e-6, 0.0, 0.0)}))
        for build in (lambda *a, **k: spatial(*a, helix=0.0, **k), planar)
    )
    for name in TILTING:
        assert not getattr(own.axes.tilting, name).any()
    assert other.axes.tilting is None
    assert own.dte == pytest.approx(other.dte, abs=1e-9 * np.abs(other.dte).max())
    force = other.axes.bearing_force
    assert own.axes.bearing_force == pytest.approx(force, abs=1e-6 * np.abs(force).max())


@pytest.mark.parametrize("held", [0, 2])
def test_the_other_hand_mirrors_what_is_along_the_axes(held):
    """Mirrored in the plane of the gears: axial ways and forces change sign, and so do tilts."""
    right, left = (
        steady(spatial(FLOWS[held], helix=helix, **{"lubrication.friction": True}))
        for helix in (0.25, -0.25)
    )
    assert left.dte == pytest.approx(right.dte, abs=1e-8 * np.abs(right.dte).max())
    for name in TILTING:
        one, two = (getattr(run.axes.tilting, name) for run in (right, left))
        assert two == pytest.approx(-one, abs=1e-6 * np.abs(one).max())
        assert np.abs(one).max() > 0.0


def constant(flow, **changes):
    """Equal planets, teeth equally stiff at all times, no friction: loads are steady."""
    return spatial(
        flow,
        **{
            "gearset.planet_angles": evenly(4),
            "mesh.double_pair_ratio": 1.0,
            "mesh.ramp": 0.0,
            "lubrication.friction": False,
        }
        | changes,
    )


@pytest.mark.parametrize("flow", [FLOWS[0], FLOWS[1], FLOWS[2]])
def test_thrust_and_moments_are_those_of_statics(flow):
    scene = constant(flow)
    run = steady(scene, 0.05)
    gears, planets = scene.gearset.geometry, scene.gearset.planets
    force = run.mesh["mesh_force_mean"][:planets].mean()  # along the line of action
    axial = force * math.tan(scene.gearset.base_helix)
    thrust = run.axes.tilting.axial_force.mean(axis=0)
    bodies = run.axes.bodies
    assert abs(thrust[bodies.index("sun")]) == pytest.approx(planets * axial, rel=1e-6)
    assert thrust[bodies.index("ring")] == pytest.approx(-thrust[bodies.index("sun")], rel=1e-6)
    assert thrust[bodies.index("carrier")] == pytest.approx(0.0, abs=1e-6 * axial)
    radius = sum(mesh.pitch_radii[k] for k, mesh in ((1, gears.meshes[0]), (0, gears.meshes[1])))
    for i in range(planets):
        moment = run.axes.tilting.tilting_moment[:, bodies.index(f"planet_{i + 1}")].mean(axis=0)
        slope = tilting_of_teeth(scene, run, bodies.index(f"planet_{i + 1}"))
        carried = np.linalg.norm(moment + slope)
        assert carried == pytest.approx(axial * radius, rel=1e-5)
        assert thrust[bodies.index(f"planet_{i + 1}")] == pytest.approx(0.0, abs=1e-6 * axial)


def tilting_of_teeth(scene, run, planet):
    """Moment about both directions that the slopes of the meshes of a planet take [N m]."""
    tilt, total = run.axes.tilting.tilt.mean(axis=0), np.zeros(2)
    psi = scene.gearset.planet_angles[planet - 3]
    turned = np.array([[math.cos(psi), math.sin(psi)], [-math.sin(psi), math.cos(psi)]])
    width, mesh = scene.gearset.face_width, scene.mesh
    for kind, stiffness in ((0, mesh.sun_planet_stiffness), (1, mesh.planet_ring_stiffness)):
        angle = scene.gearset.geometry.meshes[kind].pressure_angle
        side = math.copysign(1.0, run.mesh_force[:, 0].mean())
        lean = -1.0 if kind else 1.0
        direction = np.array([-math.cos(angle), side * lean * math.sin(angle)])
        slope = direction @ (tilt[planet] - turned @ tilt[kind])
        total += stiffness * width**2 / 12.0 * slope * direction
    return total


@pytest.mark.parametrize("flow", [FLOWS[0], FLOWS[2]])
def test_the_energy_ledger_closes(flow):
    scene = spatial(flow, **{"errors.pin_tangential": (1e-5, 0.0, 0.0)})
    run = steady(scene, 0.05)
    energy = run.energy
    assert abs(energy.residual) < 1e-6 * abs(energy.input)


def test_the_torques_of_sun_ring_and_carrier_add_up_to_zero():
    """The ring is held: its torque is that of its meshes."""
    scene = constant(FLOWS[2], input_speed=300.0)
    twin = pt.Twin(scene, 20e3, tolerance=1e-5)
    twin.advance(0.05)
    window = twin.advance(0.05)
    planets = scene.gearset.planets
    ring = window.mesh["mesh_force_mean"][planets:].sum() * scene.gearset.geometry.ring.base_radius
    assert ring > 100.0
    assert window.machine_torque.sum() + ring == pytest.approx(0.0, abs=1e-5 * 63.0)


def test_every_missing_stiffness_is_named_in_one_line():
    with pytest.raises(ValueError) as error:
        pt.load_scene("wind_turbine_stage").replace(dynamics="spatial")
    text = str(error.value)
    assert len(text.splitlines()) == 1
    for body in BODIES:
        for name in ("axial", "tilting"):
            assert f"supports.{body}.{name}" in text


def test_the_published_stage_carries_its_thrust_and_its_moments():
    """21/39/99, 15 deg, 4.18 MN m at the carrier. Sun: 4.18 MN m 21/120 tan(15 deg)/(0.55668 m/2)
    = 704 kN; each planet 2 F_a r_p = 242.7 kN m, of which the slopes of the teeth take a part."""
    scene = pt.load_scene("helical_stage")
    run = pt.simulate(scene, 1.0)
    torque, helix = 4.18e6 * 21 / 120, math.tan(math.radians(15.0))
    bodies, tilting = run.axes.bodies, run.axes.tilting
    thrust = abs(tilting.axial_force[:, bodies.index("sun")].mean())
    assert thrust == pytest.approx(torque * helix / (0.55668 / 2), rel=0.01)
    whole = 2.0 * torque / 3.0 * helix / 0.55668 * 1.0338
    assert whole == pytest.approx(242.7e3, rel=1e-3)
    moment = tilting.tilting_moment[:, 3:].mean(axis=0)
    teeth = np.array([tilting_of_teeth(scene, run, 3 + i) for i in range(3)])
    assert np.linalg.norm(moment + teeth, axis=1) == pytest.approx(whole, rel=0.01)


def test_planets_in_phase_are_integrated_once_and_carry_thrust():
    """Four equal planets in phase: the axes of sun, ring and carrier stand, but move along
    themselves."""
    grouped = constant(FLOWS[0])
    apart = constant(FLOWS[0], **{"errors.planet_thickness": (1e-15, 0.0, 0.0, 0.0)})
    few, all_ = (pt.simulate(scene, 0.01, tolerance=1e-6) for scene in (grouped, apart))
    assert few.axes.tilting.axial_force == pytest.approx(
        all_.axes.tilting.axial_force, abs=1e-4 * np.abs(all_.axes.tilting.axial_force).max()
    )
