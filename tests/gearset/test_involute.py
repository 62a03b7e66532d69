"""Tooth geometry: the outlines are involutes, and mounted gears mesh without overlap or gap."""

import math

import numpy as np
import pytest

from planetary_twin_py.gearset.involute import SpurGear
from planetary_twin_py.gearset.kinematics import Teeth, speed_ratios
from planetary_twin_py.gearset.mount import mount
from planetary_twin_py.gearset.solid import circle, extrude

MODULE = 0.8e-3
ALPHA = math.radians(21.34)
PAPER = Teeth(30, 20, 70), tuple(np.radians([90.0, -28.8, 208.8]))
FIVE_PLANETS = Teeth(30, 20, 70), tuple(2 * math.pi * k / 5 for k in range(5))
ODD_PLANETS = Teeth(21, 39, 99), tuple(2 * math.pi * k / 3 for k in range(3))
SETS = pytest.mark.parametrize("teeth, planet_angles", [PAPER, FIVE_PLANETS, ODD_PLANETS])
SUN, RING = SpurGear(30, MODULE, ALPHA), SpurGear(70, MODULE, ALPHA, internal=True)


def gap_to(mate, angle, xy):
    """Smallest gap [m] along the pitch line between a planet's outline and both flanks of `mate`.

    The mate is centred on the origin with tooth 0 at `angle`.
    """
    radius, direction = np.hypot(*xy), np.arctan2(xy[1], xy[0])
    side = -1.0 if mate.internal else 1.0
    reach = side * (radius - mate.tip_radius) < 0.0
    pitch = 2 * math.pi / mate.teeth
    from_gap = np.mod(direction[reach] - angle, pitch) - 0.5 * pitch
    room = 0.5 * pitch - mate.half_thickness(radius[reach])
    return np.array([(room - from_gap).min(), (room + from_gap).min()]) * mate.pitch_radius


def placed(outline, angle, centre):
    """Outline in Cartesian coordinates, turned by `angle` and moved to `centre`."""
    radius, direction = outline.T
    return np.array(
        [
            centre[0] + radius * np.cos(direction + angle),
            centre[1] + radius * np.sin(direction + angle),
        ]
    )


@SETS
@pytest.mark.parametrize("held", ["carrier", "ring", "sun"])
@pytest.mark.parametrize("turned", [0.0, 0.013, 0.1, 1.7, 5.9])
def test_flanks_touch_and_never_overlap_as_the_gears_roll(teeth, planet_angles, held, turned):
    """At any angle, the flanks of every mesh touch on both sides."""
    reference = "carrier" if held == "sun" else "sun"
    angle = {k: float(v) * turned for k, v in speed_ratios(teeth, held, reference).items()}
    mounted = mount(teeth, planet_angles)
    outline = SpurGear(teeth.planet, MODULE, ALPHA).outline(points=200)
    sun, ring = SpurGear(teeth.sun, MODULE, ALPHA), SpurGear(teeth.ring, MODULE, ALPHA, 1.0, True)
    radius = 0.5 * MODULE * (teeth.sun + teeth.planet)
    for i, psi in enumerate(planet_angles):
        at = psi + angle["carrier"]
        centre = radius * math.cos(at), radius * math.sin(at)
        planet = placed(outline, mounted.planets[i] + angle["planet"], centre)
        gaps = [
            *gap_to(sun, mounted.sun + angle["sun"], planet),
            *gap_to(ring, mounted.ring + angle["ring"], planet),
        ]
        assert min(gaps) > -1e-3 * MODULE
        assert max(gaps) < 0.05 * MODULE


def test_tooth_zero_of_the_sun_meets_planet_one():
    mounted = mount(*PAPER)
    flank = mounted.sun + SUN.half_thickness(np.array(SUN.pitch_radius))
    assert flank == pytest.approx(PAPER[1][0], abs=1e-12)


def test_tooth_is_half_a_pitch_wide_on_the_pitch_circle():
    for gear in (SUN, RING):
        half = gear.half_thickness(np.array(gear.pitch_radius))
        assert 2 * half * gear.pitch_radius == pytest.approx(math.pi * MODULE / 2, rel=1e-12)


def test_flank_points_lie_on_an_unwinding_string():
    """The end of a string of length s that unwinds from the base circle draws the flank."""
    string = np.linspace(0.1e-3, 5e-3, 50)
    radius = np.hypot(SUN.base_radius, string)
    unwound = string / SUN.base_radius - np.arctan(string / SUN.base_radius)
    flank = SUN.half_thickness(radius) + unwound
    assert np.allclose(flank, flank[0], atol=1e-12)


@pytest.mark.parametrize("gear", [SUN, RING])
def test_outline_runs_once_around_from_tip_to_root_circle(gear):
    outline = gear.outline()
    ends = sorted([gear.tip_radius, gear.root_radius])
    assert [outline[:, 0].min(), outline[:, 0].max()] == pytest.approx(ends)
    assert abs(gear.tip_radius - gear.root_radius) == pytest.approx(2.25 * MODULE)
    assert np.all(np.diff(outline[:, 1]) >= 0)
    assert outline[-1, 1] - outline[0, 1] < 2 * math.pi


def test_teeth_that_cannot_be_drawn_are_refused_in_one_line():
    with pytest.raises(ValueError, match="teeth = 6: the tooth is pointed"):
        SpurGear(6, MODULE, math.radians(38))
    with pytest.raises(ValueError, match="teeth = 25: the ring's tips are inside"):
        SpurGear(25, MODULE, math.radians(20), internal=True)


def on_circle(radius, outline):
    """A circle with the angles of `outline`."""
    return np.column_stack((np.full(len(outline), radius), outline[:, 1]))


@pytest.mark.parametrize(
    ("inner", "outer"),
    [
        (5e-3, SUN.outline()),
        (0.0, SUN.outline()),
        (RING.outline(), 33e-3),
        (4e-3, circle(9e-3)),
        (on_circle(SUN.root_radius, SUN.outline()), SUN.outline()),
    ],
)
def test_extruded_mesh_is_closed_and_faces_outwards(inner, outer):
    """The divergence theorem over the triangles gives outline area times height."""
    solid = extrude(inner, outer, -0.01, 0.01)
    a, b, c = (solid.vertices[solid.faces[:, k]].astype(float) for k in range(3))
    volume = np.einsum("ij,ij->", a, np.cross(b, c)) / 6
    angles = (outer if isinstance(outer, np.ndarray) else inner)[:, 1]

    def area(edge):
        radius = edge[:, 0] if isinstance(edge, np.ndarray) else np.full_like(angles, edge)
        x, y = radius * np.cos(angles), radius * np.sin(angles)
        return 0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))

    assert volume == pytest.approx(0.02 * (area(outer) - area(inner)), rel=1e-5)
    facing = np.einsum("ij,ij->i", np.cross(b - a, c - a), solid.normals[solid.faces[:, 0]])
    assert np.all(facing > 0)


def test_a_twisted_body_keeps_its_volume_and_outward_faces():
    """Sections are turned, not changed (Cavalieri); layers approach the twisted walls."""
    body = extrude(5e-3, SUN.outline(), -0.01, 0.01, layers=16).twisted(30.0)
    a, b, c = (body.vertices[body.faces[:, k]].astype(float) for k in range(3))
    straight = extrude(5e-3, SUN.outline(), -0.01, 0.01)
    d, e, f = (straight.vertices[straight.faces[:, k]].astype(float) for k in range(3))
    volumes = [np.einsum("ij,ij->", p, np.cross(q, r)) for p, q, r in ((a, b, c), (d, e, f))]
    assert volumes[0] == pytest.approx(volumes[1], rel=2e-3)
    facing = np.einsum("ij,ij->i", np.cross(b - a, c - a), body.normals[body.faces[:, 0]])
    assert np.all(facing > 0)
    assert np.hypot(*body.vertices[:, :2].T).max() == pytest.approx(SUN.tip_radius, rel=1e-6)
