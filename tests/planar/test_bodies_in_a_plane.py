"""Natural modes and static load sharing against a model of bodies with forces at points."""

import math
from dataclasses import replace

import numpy as np
import pytest
from planar.bodies_in_a_plane import Bodies, Forces, jacobian, rates
from planar.published_set import MESH, PIN, TORQUE, scene

from planetary_twin_py.modal.planar import planar_model
from planetary_twin_py.modal.supported_set import Body, SupportedSet
from planetary_twin_py.modal.turning import turning_modes, turning_terms
from planetary_twin_py.statics.load_sharing import load_sharing

ANGLE = math.radians(21.34)
PITCH = {"sun": 0.012, "planet": 0.008, "ring": 0.028}
MASS = {"sun": 0.46, "ring": 0.588, "carrier": 3.0, "planet": 0.177}
RIM = {"sun": 0.3, "ring": 0.8, "carrier": 1.5, "planet": 0.11}  # J/r^2


def bodies(angles, **changes):
    count, cosine = len(angles), math.cos(ANGLE)
    radius = {kind: r * cosine for kind, r in PITCH.items()} | {"carrier": 0.02}
    kinds = ["sun", "ring", "carrier"] + ["planet"] * count
    data = {
        "planet_angles": tuple(angles),
        "pressure_angle": ANGLE,
        "pitch_radius": PITCH,
        "mass": np.array([MASS[kind] for kind in kinds]),
        "inertia": np.array([RIM[kind] * radius[kind] ** 2 for kind in kinds]),
        "bearing": np.array([1e8] * 3 + [PIN] * count),
        "mesh": MESH,
    }
    return Bodies(**(data | changes))


def at_rest(data, free, guess):
    """Displacements without acceleration, by Newton's method on differences of the forces."""
    count, q = len(free), guess
    for _ in range(50):
        state = np.concatenate([q, 0.0 * q])
        left = rates(data, state, free)[count:]
        steps = np.where(free % 3 == 2, 1e-7, 1e-9)
        slope = jacobian(data, state, free, np.concatenate([steps, steps]))[count:, :count]
        change = np.linalg.lstsq(slope, -left, rcond=1e-13)[0]
        q = q + change
        if np.abs(change / steps).max() < 1e-4:
            return q
    raise AssertionError("no rest")


@pytest.mark.parametrize("speed", [0.0, 300.0])
@pytest.mark.parametrize("angles", [(0.3, 2.0, 4.4), (0.0, 1.5708, 3.1416, 4.7124)])
def test_small_vibration_has_the_natural_frequencies(angles, speed):
    torsion = np.array([0.0, 1e9 * (PITCH["ring"] * math.cos(ANGLE)) ** 2, 0.0])
    data = bodies(angles, linear=True, speed=speed, torsion=torsion)
    free = np.arange(3 * len(data.mass))
    # About the displacement that the centrifugal load of the planets causes.
    start = at_rest(data, free, np.zeros(len(free)))
    point = np.concatenate([start, np.zeros(len(free))])
    step = np.tile([1e-6, 1e-6, 1e-4], 2 * len(data.mass))
    found = np.linalg.eigvals(jacobian(data, point, free, step))
    found = np.sort(np.abs(found.imag))[::2] / (2.0 * math.pi)
    held = Body(MASS["ring"], RIM["ring"], 1e8, 1e9)
    model = planar_model(
        SupportedSet(
            Body(MASS["sun"], RIM["sun"], 1e8), held,
            Body(MASS["carrier"], RIM["carrier"], 1e8),
            Body(MASS["planet"], RIM["planet"], PIN),
            angles, MESH, MESH, ANGLE, ANGLE,
        )
    )  # fmt: skip
    modes = turning_modes(model, turning_terms(model, speed or 1e-6, {}, angles))
    elastic = modes.frequencies > 1.0
    assert elastic.sum() == len(free) - 1
    # By this much the centrifugal load bends the pins, which the modes leave out.
    bent = MASS["planet"] * speed**2 / PIN
    assert found[-elastic.sum() :] == pytest.approx(modes.frequencies[elastic], rel=1e-6 + bent)


@pytest.mark.parametrize(("error", "backlash"), [(-1e-5, 1e-4), (-2e-5, 2e-7), (1.5e-5, 4e-6)])
def test_a_set_that_comes_to_rest_has_the_static_forces(error, backlash):
    angles = [0.0, 0.24 * 2 * math.pi, 0.5 * 2 * math.pi]
    given = scene(3, {"pin_tangential": [error, 0.0, 0.0]}, 1e6, angles, backlash=backlash)
    given = given.replace(**{"supports.ring.bearing": 1e8, "supports.carrier.bearing": 1e8})
    expected = load_sharing(given)
    pins = np.zeros((3, 2))
    pins[0] = [0.0, error]  # counter-clockwise at angle 0
    data = bodies(
        angles,
        bearing=np.array([1e6, 1e8, 1e8, PIN, PIN, PIN]),
        half_backlash=0.5 * backlash,
        torque=np.array([TORQUE, 0.0, 0.0]),
        pin_error=pins,
    )
    free = np.array([k for k in range(18) if k not in (5, 8)])  # ring and carrier do not turn
    q = np.zeros(18)
    q[free] = at_rest(data, free, at_rest(replace(data, linear=True), free, np.zeros(16)))
    rest = Forces(data, q.reshape(6, 3), np.zeros((6, 3)))
    assert rest.flank == pytest.approx(expected.mesh_force[0], abs=1.0)
    assert q[:2] == pytest.approx(expected.displacement[0, 0], abs=1e-8)
    assert expected.both_flanks == (backlash < 1e-5)
