"""Tooth geometry: the outlines are involutes, and mounted gears mesh without overlap or gap."""

import math

import numpy as np
import pytest

from planetary_twin_py.gearset.geometry import GearsetGeometry
from planetary_twin_py.gearset.involute import gear_outline, half_thickness, tooth_outline
from planetary_twin_py.gearset.mount import assembly_error, mount
from planetary_twin_py.gearset.solid import circle, extrude

MODULE = 0.8e-3
ALPHA = math.radians(21.34)
PAPER = GearsetGeometry(
    30, 20, 70, MODULE, ALPHA, tuple(np.radians([90.0, -28.8, 208.8])), 20e-3
)
FIVE_PLANETS = GearsetGeometry(
    30, 20, 70, MODULE, ALPHA, tuple(2 * math.pi * k / 5 for k in range(5)), 20e-3
)
ODD_PLANETS = GearsetGeometry(
    21, 39, 99, 26.5e-3, math.radians(20), tuple(2 * math.pi * k / 3 for k in range(3)), 0.62
)
SETS = pytest.mark.parametrize("geometry", [PAPER, FIVE_PLANETS, ODD_PLANETS])


def clearances(planet_xy, teeth, geometry, angle, internal):
    """Smallest gap [m] along the pitch line between a planet's outline and both flanks of a mate.

    The mate is centred on the origin with tooth 0 at `angle`.
    """
    radius, direction = np.hypot(*planet_xy), np.arctan2(planet_xy[1], planet_xy[0])
    side = -1.0 if internal else 1.0
    pitch_radius = geometry.pitch_radius(teeth)
    reach = side * (radius - pitch_radius) < geometry.module  # inside the mate's tip circle
    radius, direction = radius[reach], direction[reach]
    pitch = 2 * math.pi / teeth
    from_gap = np.mod(direction - angle, pitch) - 0.5 * pitch
    half = half_thickness(radius, teeth, geometry.module, geometry.pressure_angle, internal)
    room = 0.5 * pitch - half
    return (room - from_gap).min() * pitch_radius, (room + from_gap).min() * pitch_radius


def placed(outline, angle, centre):
    radius, direction = outline.T
    return np.array([
        centre[0] + radius * np.cos(direction + angle),
        centre[1] + radius * np.sin(direction + angle),
    ])


@SETS
@pytest.mark.parametrize("sun_angle", [0.0, 0.013, 0.1, 1.7, 5.9])
@pytest.mark.parametrize("carrier_angle", [0.0, 0.77])
def test_flanks_touch_and_never_overlap_as_the_gears_roll(geometry, sun_angle, carrier_angle):
    """Willis' equations turn the gears; every mesh keeps its flanks together on both sides."""
    stand = mount(geometry)
    z_s, z_p, z_r = geometry.sun_teeth, geometry.planet_teeth, geometry.ring_teeth
    rolled = sun_angle - carrier_angle
    outline = gear_outline(z_p, geometry.module, geometry.pressure_angle, points=200)
    for i, psi in enumerate(geometry.planet_angles):
        at = psi + carrier_angle
        centre = geometry.carrier_radius * np.array([math.cos(at), math.sin(at)])
        planet = placed(outline, stand.planets[i] + carrier_angle - rolled * z_s / z_p, centre)
        sun = clearances(planet, z_s, geometry, stand.sun + sun_angle, internal=False)
        ring_angle = stand.ring + carrier_angle - rolled * z_s / z_r
        ring = clearances(planet, z_r, geometry, ring_angle, internal=True)
        for gap in (*sun, *ring):
            assert -1e-3 * geometry.module < gap < 0.05 * geometry.module


def test_the_papers_equally_spaced_planets_would_not_assemble():
    thirds = GearsetGeometry(30, 20, 70, MODULE, ALPHA, tuple(np.radians([90, -30, 210])), 20e-3)
    assert np.allclose(assembly_error(PAPER), 0.0, atol=1e-12)
    assert np.allclose(np.abs(assembly_error(thirds)), [0, 0.838e-3, 0.838e-3], atol=1e-6)


def test_tooth_is_half_a_pitch_wide_on_the_pitch_circle():
    for teeth, internal in ((30, False), (20, False), (70, True)):
        pitch_radius = 0.5 * MODULE * teeth
        half = half_thickness(pitch_radius, teeth, MODULE, ALPHA, internal)
        assert 2 * half * pitch_radius == pytest.approx(math.pi * MODULE / 2, rel=1e-12)


def test_flank_points_lie_on_an_unwinding_string():
    """The normal to an involute at radius r touches the base circle: sqrt(r^2 - r_b^2) long."""
    base = 0.5 * MODULE * 30 * math.cos(ALPHA)
    radius = np.linspace(1.001 * base, 12.8e-3, 50)
    half = half_thickness(radius, 30, MODULE, ALPHA)
    string = np.sqrt(radius**2 - base**2)
    unwound = half[0] + string[0] / base - np.arctan(string[0] / base)
    assert np.allclose(half + string / base - np.arctan(string / base), unwound, atol=1e-12)


@pytest.mark.parametrize("internal", [False, True])
def test_outline_runs_once_around_with_addendum_one_and_dedendum_five_quarters(internal):
    outline = gear_outline(70, MODULE, ALPHA, internal)
    side = -1 if internal else 1
    radii = np.sort(side * (outline[:, 0] - 35 * MODULE))
    assert radii[[0, -1]] == pytest.approx([-1.25 * MODULE, MODULE])
    assert np.all(np.diff(outline[:, 1]) >= 0)
    assert outline[-1, 1] - outline[0, 1] < 2 * math.pi


def test_pointed_teeth_are_refused_in_one_line():
    with pytest.raises(ValueError, match="pointed"):
        tooth_outline(6, MODULE, math.radians(38))


@pytest.mark.parametrize(
    ("inner", "outer"),
    [
        (5e-3, gear_outline(30, MODULE, ALPHA)),
        (0.0, gear_outline(30, MODULE, ALPHA)),
        (gear_outline(70, MODULE, ALPHA, internal=True), 33e-3),
        (4e-3, circle(9e-3)),
    ],
)
def test_extruded_mesh_is_closed_and_faces_outwards(inner, outer):
    """The divergence theorem over the triangles gives outline area times height."""
    solid = extrude(inner, outer, -0.01, 0.01)
    a, b, c = (solid.vertices[solid.faces[:, k]].astype(float) for k in range(3))
    volume = np.einsum("ij,ij->", a, np.cross(b, c)) / 6

    def area(edge):
        if not isinstance(edge, np.ndarray):
            return None
        x, y = edge[:, 0] * np.cos(edge[:, 1]), edge[:, 0] * np.sin(edge[:, 1])
        return 0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))

    def polygon(edge, other):
        return area(edge if isinstance(edge, np.ndarray) else np.column_stack(
            (np.full(len(other), edge), other[:, 1])))

    expected = 0.02 * (polygon(outer, inner) - polygon(inner, outer))
    assert volume == pytest.approx(expected, rel=1e-5)
    facing = np.einsum("ij,ij->i", np.cross(b - a, c - a), solid.normals[solid.faces[:, 0]])
    assert np.all(facing > 0)
