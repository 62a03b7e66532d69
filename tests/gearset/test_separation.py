"""Separation of teeth off the path of contact, against drawn flanks that are turned by hand."""

import math

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

import planetary_twin_py as pt
from planetary_twin_py.gearset.separation import separation

SCENES = ["paper", "reference_gearbox_stage", "wind_turbine_stage", "floating_sun"]


def turned(points, angle):
    return points * np.exp(1j * angle)


def flank(base, roll):
    """An involute that begins on the real axis, at a roll angle."""
    return base * (1.0 - 1j * roll) * np.exp(1j * roll)


def drawn(mesh, s):
    """Both flanks at a distance s after the pitch point, as functions of their roll angle.

    At the pitch point both pass (r_w, 0) with their normal along the line of action. From there
    each gear turns by s over its base radius.
    """
    start = np.angle(flank(1.0, math.tan(mesh.pressure_angle)))

    def first(roll):
        there = np.conj(turned(flank(mesh.first.base_radius, roll), -start))
        return turned(there, s / mesh.first.base_radius)

    def ring(roll):
        there = np.conj(turned(flank(mesh.second.base_radius, roll), -start))
        return turned(there, s / mesh.second.base_radius) - mesh.centre_distance

    def second(roll):  # about its centre on the other side of the pitch point, the other way round
        there = turned(flank(mesh.second.base_radius, roll), -start)
        return mesh.centre_distance - np.conj(turned(there, s / mesh.second.base_radius))

    return first, ring if mesh.internal else second


def roll_at(gear, radius):
    return math.tan(math.acos(gear.base_radius / radius))


def distance(point, curve, least, most):
    """Shortest way from a point to a curve."""
    rolls = np.linspace(least, most, 4001)
    near = int(np.argmin(np.abs(curve(rolls) - point)))
    ends = rolls[max(near - 1, 0)], rolls[min(near + 1, 4000)]
    best = minimize_scalar(
        lambda roll: abs(curve(roll) - point), bounds=ends, method="bounded",
        options={"xatol": 1e-13},
    )  # fmt: skip
    return best.fun


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("kind", [0, 1])
@pytest.mark.parametrize("beyond", [0.02, 0.06, 0.1])
def test_it_is_the_distance_of_a_tip_from_the_mating_flank(name, kind, beyond):
    mesh = pt.load_scene(name).gearset.geometry.meshes[kind]
    path = mesh.path
    for position in (-path.approach - beyond, path.recess + beyond):
        curves = drawn(mesh, mesh.base_pitch * position)
        tip = 1 if position < 0.0 else 0  # whose tip is near the other's flank
        gears = (mesh.first, mesh.second)
        point = curves[tip](roll_at(gears[tip], gears[tip].tip_radius))
        mate = gears[1 - tip]
        far = mate.tip_radius if not mate.internal else 1.3 * mate.pitch_radius
        expected = distance(point, curves[1 - tip], 0.0, roll_at(mate, far))
        found = float(separation(mesh, np.array(position)))
        assert found == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize("kind", [0, 1])
def test_it_is_nothing_on_the_path_and_grows_with_the_square_beyond(kind):
    mesh = pt.load_scene("paper").gearset.geometry.meshes[kind]
    path = mesh.path
    on = np.linspace(-path.approach, path.recess, 101)
    np.testing.assert_array_equal(separation(mesh, on), 0.0)
    for end, sign in ((-path.approach, -1.0), (path.recess, 1.0)):
        near, far = (float(separation(mesh, np.array(end + sign * x))) for x in (1e-3, 2e-3))
        assert far / near == pytest.approx(4.0, rel=5e-3)
        assert near > 0.0
