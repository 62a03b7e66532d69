"""Small motions about a spatial run have the frequencies of the spatial modes."""

import math

import numpy as np
import pytest
from planar.test_ring_down import expected, frequencies, ringing
from power_flows import FLOWS
from spatial.tilting_scenes import spatial


@pytest.mark.parametrize("planets", [3, 5])
@pytest.mark.parametrize("helix", [1e-9, 0.3, -0.2])
def test_with_the_carrier_held_they_are_those_without_spin(planets, helix):
    scene = ringing(FLOWS[0], planets, 1e-3, spatial, helix=helix)
    wanted = expected(scene, "spatial")
    assert frequencies(scene, len(wanted)) == pytest.approx(wanted, rel=1e-6)


@pytest.mark.parametrize("flow, speed", [(FLOWS[0], 300.0), (FLOWS[2], 600.0), (FLOWS[1], 400.0)])
def test_gyroscopic_moments_are_those_of_the_turning_modes(flow, speed):
    scene = ringing(flow, 3, speed, spatial)
    wanted = expected(scene, "spatial", at_rest=False)
    assert frequencies(scene, len(wanted)) == pytest.approx(wanted, rel=1e-6)


def test_gyroscopic_moments_part_the_tilting_modes_of_a_free_sun():
    """A disc on a tilting spring without teeth: (+-J w + sqrt(J^2 w^2 + 4 I k))/(2 I) in the
    housing, which is the frame where the carrier is held."""
    speed = 900.0
    soft = {"mesh.sun_planet_stiffness": 1e3, "mesh.planet_ring_stiffness": 1e3}
    scene = ringing(FLOWS[0], 3, speed, spatial, helix=1e-9, input_torque=1e-6, **soft)
    support, gears = scene.supports.sun, scene.gearset.geometry
    r = gears.sun.base_radius
    polar = scene.gearset.rim_masses.sun / math.cos(scene.gearset.pressure_angle) ** 2 * r**2
    inertia, spring = 0.5 * polar, support.tilting * r**2
    root = math.sqrt((polar * speed) ** 2 + 4.0 * inertia * spring)
    found = frequencies(scene, 20)
    for sign in (1.0, -1.0):
        wanted = (sign * polar * speed + root) / (2.0 * inertia) / (2.0 * math.pi)
        assert np.abs(found / wanted - 1.0).min() < 2e-5
