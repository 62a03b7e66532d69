"""Small motions about a spatial run have the frequencies of the spatial modes."""

import math

import numpy as np
import pytest
from planar.moving_scenes import evenly
from planar.test_ring_down import TINY, equations
from power_flows import FLOWS
from spatial.tilting_scenes import BODIES, spatial

from planetary_twin_py import natural_modes

SOFT = {"coupling_stiffness": 1e-2, "coupling_damping": 0.0, "inertia": 1.0}


def ringing(flow, planets, speed, helix=0.3, **changes):
    """A scene without damping or friction, whose teeth are equally stiff at all times."""
    damping = ("damping", "axial_damping", "tilting_damping")
    return spatial(
        flow,
        helix=helix,
        **{
            "gearset.planet_angles": evenly(planets),
            "mesh.double_pair_ratio": 1.0,
            "mesh.ramp": 0.0,
            "mesh.damping.law": "viscous",
            "mesh.damping.damping_ratio": 0.0,
            "lubrication.friction": False,
            "drive.speed_control.bandwidth": 1e-3,
            "input_torque": math.copysign(0.5, flow[3]),
            "input_speed": speed,
            "errors.planet_thickness": (TINY, *[0.0] * (planets - 1)),
        }
        | {f"drive.{side}.{name}": value for side in ("input", "output")
           for name, value in SOFT.items()}
        | {f"supports.{body}.{name}": 0.0 for body in BODIES for name in damping}
        | changes,
    )  # fmt: skip


def frequencies(scene):
    """Of small motions about the start of a run [Hz]."""
    mass, by_x, by_v = equations(scene)
    n = len(mass)
    system = np.block([[np.zeros((n, n)), np.eye(n)], [by_x / mass[:, None], by_v / mass[:, None]]])
    found = np.linalg.eigvals(system)
    return np.sort(found.imag[found.imag > 0.0]) / (2.0 * math.pi)


@pytest.mark.parametrize("planets", [3, 5])
@pytest.mark.parametrize("helix", [1e-9, 0.3, -0.2])
def test_with_the_carrier_held_they_are_those_at_rest_without_spin(planets, helix):
    scene = ringing(FLOWS[0], planets, 1e-3, helix)
    wanted = natural_modes(scene, "spatial").frequencies
    wanted = wanted[wanted > 20.0]
    assert frequencies(scene)[-len(wanted) :] == pytest.approx(wanted, rel=1e-6)


@pytest.mark.parametrize("flow, speed", [(FLOWS[0], 300.0), (FLOWS[2], 600.0), (FLOWS[1], 400.0)])
def test_gyroscopic_moments_are_those_of_the_turning_modes(flow, speed):
    scene = ringing(flow, 3, speed)
    wanted = natural_modes(scene, "spatial", input_speed=speed).frequencies
    wanted = wanted[wanted > 20.0]
    assert frequencies(scene)[-len(wanted) :] == pytest.approx(wanted, rel=1e-6)


def test_gyroscopic_moments_part_the_tilting_modes_of_a_free_sun():
    """A disc on a tilting spring without teeth: (+-J w + sqrt(J^2 w^2 + 4 I k))/(2 I) in the
    housing, which is the frame where the carrier is held."""
    speed = 900.0
    soft = {"mesh.sun_planet_stiffness": 1e3, "mesh.planet_ring_stiffness": 1e3}
    scene = ringing(FLOWS[0], 3, speed, 1e-9, input_torque=1e-6, **soft)
    support, gears = scene.supports.sun, scene.gearset.geometry
    r = gears.sun.base_radius
    polar = scene.gearset.rim_masses.sun / math.cos(scene.gearset.pressure_angle) ** 2 * r**2
    inertia, spring = 0.5 * polar, support.tilting * r**2
    root = math.sqrt((polar * speed) ** 2 + 4.0 * inertia * spring)
    found = frequencies(scene)
    for sign in (1.0, -1.0):
        wanted = (sign * polar * speed + root) / (2.0 * inertia) / (2.0 * math.pi)
        assert np.abs(found / wanted - 1.0).min() < 2e-5
