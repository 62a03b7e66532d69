"""Modes of a gear set whose carrier turns, against closed forms and a general eigenvalue solver."""

import math

import numpy as np
import pytest
from modal.test_planar import equal, lin_parker
from modal.test_spatial import spatial
from planar.moving_scenes import planar
from power_flows import DIFFERENTIALS
from scipy.linalg import eigvals

import planetary_twin_py as pt
from planetary_twin_py.modal.natural import spring_model
from planetary_twin_py.modal.planar import planar_model
from planetary_twin_py.modal.spatial import spatial_model
from planetary_twin_py.modal.supported_set import Body
from planetary_twin_py.modal.turning import turning_modes, turning_terms

SPINS = {"sun": 700.0, "planet": -300.0, "ring": 0.0, "carrier": 200.0}


def modes_at(model, speed, angles):
    spins = {kind: spin * speed / SPINS["carrier"] for kind, spin in SPINS.items()}
    return turning_modes(model, turning_terms(model, speed, spins, angles))


@pytest.mark.parametrize("speed", [20.0, 500.0])
def test_an_axis_whirls_at_its_frequency_less_and_plus_speed(speed):
    soft = lin_parker(equal(3), sun_planet=1e-3)
    found = modes_at(planar_model(soft), speed, soft.planet_angles).frequencies
    own = math.sqrt(1e8 / 0.4)
    for expected in ((own - speed) / (2 * math.pi), (own + speed) / (2 * math.pi)):
        assert np.abs(found - expected).min() == pytest.approx(0.0, abs=1e-6)


def test_a_spinning_sun_tilts_as_a_gyroscope():
    speed, soft = 200.0, spatial(0.2, sun_planet=1e-3, planet_ring=1e-3)
    found = modes_at(spatial_model(soft), speed, soft.planet_angles).frequencies
    polar, diametral, spin, stiffness = 0.39, 0.2, SPINS["sun"], 0.4e8
    root = math.sqrt(polar**2 * spin**2 + 4.0 * diametral * stiffness)
    for sense in (1.0, -1.0):
        in_housing = (sense * polar * spin + root) / (2.0 * diametral)
        in_frame = (in_housing - sense * speed) / (2.0 * math.pi)
        assert np.abs(found - in_frame).min() == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("planets", [3, 5])
@pytest.mark.parametrize("kind", ["planar", "spatial"])
def test_frequencies_are_those_of_a_general_solver(planets, kind):
    angles = tuple(2.0 * math.pi * np.arange(planets) / planets)
    if kind == "planar":
        model = planar_model(lin_parker(equal(planets)))
    else:
        model = spatial_model(spatial(0.2, planet_angles=angles))
    terms = turning_terms(model, 400.0, SPINS, angles)
    size, inverse = len(model.mass), 1.0 / model.mass[:, None]
    companion = np.block(
        [
            [np.zeros((size, size)), np.eye(size)],
            [-inverse * (model.stiffness - terms.centripetal), -inverse * terms.gyroscopic],
        ]
    )
    found = turning_modes(model, terms).frequencies
    general = np.sort(np.abs(eigvals(companion).imag))[::2] / (2.0 * math.pi)
    assert found[1:] == pytest.approx(general[1:], rel=1e-7)
    assert found[0] == 0.0


def test_a_mode_keeps_its_shape_as_it_moves():
    data = lin_parker(equal(3))
    model, speed = planar_model(data), 300.0
    terms = turning_terms(model, speed, SPINS, data.planet_angles)
    modes = turning_modes(model, terms)
    for frequency, shape in zip(modes.frequencies[1:], modes.shapes.T[1:], strict=True):
        rate = -2j * math.pi * frequency
        left = rate**2 * model.mass * shape + rate * terms.gyroscopic @ shape
        left += (model.stiffness - terms.centripetal) @ shape
        assert np.abs(left).max() < 1e-9 * (2 * math.pi * modes.frequencies[-1]) ** 2


def test_turning_splits_translational_pairs_and_no_others():
    data = lin_parker(equal(4))
    still, turning = (
        modes_at(planar_model(data), speed, data.planet_angles) for speed in (1e-3, 300.0)
    )
    for kind, count in (("rotational", 5), ("planet", 3), ("translational", 12), ("rigid", 1)):
        assert turning.kinds.count(kind) == still.kinds.count(kind) == count
    pairs = turning.frequencies[[kind == "translational" for kind in turning.kinds]]
    assert np.diff(pairs).min() > 1.0


def test_a_rigid_rotation_stays_rigid_though_the_carrier_turns():
    data = lin_parker(equal(3))
    free = lin_parker(equal(3), ring=Body(2.35, 3.0, 1e8))
    assert modes_at(planar_model(free), 300.0, data.planet_angles).kinds[:2] == ("rigid", "rigid")


def test_an_axis_above_its_critical_speed_centres_itself():
    """Its bearing yields to centrifugal forces, but Coriolis forces turn it back."""
    speed, weak = 300.0, lin_parker(equal(3), sun=Body(0.4, 0.39, 4e3), sun_planet=1e-6)
    found = modes_at(planar_model(weak), speed, weak.planet_angles).frequencies
    own = math.sqrt(4e3 / 0.4)
    assert own < speed
    for expected in ((speed - own) / (2 * math.pi), (own + speed) / (2 * math.pi)):
        assert np.abs(found - expected).min() == pytest.approx(0.0, abs=1e-6)


def uneven(square):
    """Planets on pins that are stiffer along one direction, on a carrier that does not move."""
    return lin_parker(
        equal(3),
        carrier=Body(1e9, 1e9, 1e8),
        planet=Body(0.5, 0.6, 0.5 * square, across=0.5 * 4.0 * square),
        sun_planet=1e-3,
        planet_ring=1e-3,
    )


def test_unequal_stiffness_is_unstable_between_its_speeds():
    """Growth of an asymmetric rotor: s^4 + (a + b + 2 W^2) s^2 + (a - W^2)(b - W^2) = 0 with the
    squares a and b of both critical speeds (Den Hartog 1956, Mechanical Vibrations)."""
    first, second = 200.0, 400.0
    data = uneven(first**2)
    for speed in (0.9 * first, 1.1 * second):
        modes_at(planar_model(data), speed, data.planet_angles)
    speed = 300.0
    half = 0.5 * (first**2 + second**2) + speed**2
    product = (first**2 - speed**2) * (second**2 - speed**2)
    growth = math.sqrt(math.sqrt(half**2 - product) - half)
    with pytest.raises(ValueError, match=f"it grows with {growth:.3g} 1/s"):
        modes_at(planar_model(data), speed, data.planet_angles)


def test_modes_of_a_scene_are_those_at_the_speed_of_its_carrier():
    scene = pt.load_scene("wind_turbine_stage")
    speed = scene.operating_point.input_speed  # of the carrier
    found = pt.natural_modes(scene, "planar", input_speed=100.0 * speed)
    model = spring_model(scene, "planar")
    terms = turning_terms(model, 100.0 * speed, SPINS, scene.gearset.planet_angles)
    assert found.frequencies == pytest.approx(turning_modes(model, terms).frequencies)
    still = pt.natural_modes(scene, "planar").frequencies
    assert np.abs(found.frequencies - still).max() > 1.0
    torsional = pt.natural_modes(scene, input_speed=speed).frequencies
    assert torsional == pytest.approx(pt.natural_modes(scene).frequencies)


def test_the_second_motor_of_a_differential_turns_the_carrier():
    scene = planar(DIFFERENTIALS[0], second_input_speed=pt.rpm(-2000.0))
    first = pt.rpm(600.0)
    found = pt.natural_modes(scene, "planar", input_speed=first).frequencies
    model, sun, carrier = spring_model(scene, "planar"), first, pt.rpm(-2000.0)
    ring = carrier - (sun - carrier) * 30 / 70
    spins = {"sun": sun, "ring": ring, "carrier": carrier, "planet": carrier}
    terms = turning_terms(model, carrier, spins, scene.gearset.planet_angles)
    assert found == pytest.approx(turning_modes(model, terms).frequencies)
    still = pt.natural_modes(scene, "planar")
    assert np.abs(found - still.frequencies).max() > 5.0
    stood = pt.natural_modes(scene.replace(second_input_speed=0.0), "planar", input_speed=first)
    assert stood.frequencies == pytest.approx(still.frequencies)  # of the carrier at rest
