"""Rolling bearings against sums over their elements, published numbers, and statics."""

import math
import re

import numpy as np
import pytest
from planar.moving_scenes import MASSES, planar
from planar.published_set import MESH, PIN, TORQUE, scene
from planar.rolling_law import element, force_of_elements, size_under, slope, spread_force
from power_flows import FLOWS, flow_name
from scipy.integrate import quad
from spatial.tilting_scenes import spatial
from tiers import first

from planetary_twin_py import SceneError, simulate
from planetary_twin_py.modal.natural import spring_model
from planetary_twin_py.model.rolling_bearings import (
    eccentricity,
    largest_element_load,
    press,
    rolling_bearing,
)
from planetary_twin_py.scene.supports import Rolling
from planetary_twin_py.statics.load_sharing import load_sharing
from planetary_twin_py.statics.small_motion import radial_stiffness

ROLLERS = Rolling(rollers=14, length=0.012)
BALLS = Rolling(balls=9, diameter=0.008)
THREE = {"gearset.teeth": {"sun": 30, "planet": 21, "ring": 72}}
THIRD = 2.0 * math.pi / 3.0


@pytest.mark.parametrize("rolling", [ROLLERS, BALLS], ids=["rollers", "balls"])
@pytest.mark.parametrize("clearance", [0.0, 1e-6, 2e-5])
def test_energy_force_and_stiffness_are_those_of_elements(rolling, clearance):
    law = rolling_bearing(rolling)
    for size in clearance + np.array([1e-9, 1e-7, 3e-6, 4e-5]):
        energy, force, stiffness = press(law, clearance, np.array([size]))[:, 0]
        assert force == pytest.approx(spread_force(rolling, clearance, size), rel=1e-9)

        def force_at(at):
            return float(press(law, clearance, np.array([at]))[1, 0])

        stored = quad(force_at, clearance, size, epsabs=0.0, epsrel=1e-11)[0]
        assert energy == pytest.approx(stored, rel=1e-9)
        step = 1e-3 * (size - clearance)
        assert stiffness == pytest.approx(slope(force_at, size, step), rel=1e-5)
    assert (press(law, clearance, np.array([0.0, 0.5 * clearance, clearance])) == 0.0).all()


def test_bearing_of_14_rollers_yields_as_published_laws_have_it():
    law = rolling_bearing(ROLLERS)
    size = eccentricity(law, 0.0, 3500.0)
    assert size == pytest.approx(5.374e-6, rel=1e-3)
    stiffness = press(law, 0.0, np.array([size]))[2, 0]
    assert stiffness == pytest.approx(7.24e8, rel=1e-3)
    # Friswell, Penny, Garvey and Lees 2010, in SI, with the load in N
    assert stiffness == pytest.approx(1e9 * 14**0.9 * 0.012**0.8 * 3500.0**0.1, rel=0.025)
    law = rolling_bearing(BALLS)
    size = eccentricity(law, 0.0, 3500.0)
    published = 13e6 * 9 ** (2 / 3) * 0.008 ** (1 / 3) * 3500.0 ** (1 / 3)
    assert press(law, 0.0, np.array([size]))[2, 0] == pytest.approx(published, rel=0.01)


@pytest.mark.parametrize(("rolling", "factor"), [(ROLLERS, 4.08), (BALLS, 4.37)])
def test_the_most_loaded_element_has_the_share_of_stribeck(rolling, factor):
    count, _, _ = element(rolling)
    size = np.array([eccentricity(rolling_bearing(rolling), 0.0, 3500.0)])
    found = largest_element_load(rolling, 0.0, size)[0]
    assert found == pytest.approx(factor * 3500.0 / count, rel=2e-3)


def test_a_clearance_is_between_two_places_of_its_rollers():
    """One in line with the load, or two beside it: 28.22 um with 5.65e8 N/m is the first."""
    clearance, load, law = 2e-5, 3500.0, rolling_bearing(ROLLERS)
    found = []
    for place in (0.0, 0.5):

        def force(size, place=place):
            return force_of_elements(ROLLERS, clearance, size, place)

        size = size_under(force, load, clearance)
        found.append((size, slope(force, size)))
    assert found[0] == pytest.approx((28.22e-6, 5.65e8), rel=1e-3)
    size = eccentricity(law, clearance, load)
    assert found[0][0] < size < found[1][0]
    stiffness = press(law, clearance, np.array([size]))[2, 0]
    assert stiffness == pytest.approx(0.5 * (found[0][1] + found[1][1]), rel=0.01)


@pytest.mark.parametrize("rolling", [ROLLERS, BALLS], ids=["rollers", "balls"])
@pytest.mark.parametrize("clearance", [0.0, 5e-6])
def test_a_sun_on_rollers_balances_the_error_of_a_pin(rolling, clearance):
    """(2/N) eps is the place of a sun that floats, N K/2 the stiffness that pulls it there."""
    error, angle = -2e-5, math.radians(21.34)
    branch = 1.0 / (2.0 / MESH + 4.0 * math.cos(angle) ** 2 / PIN)
    free, pull = 2.0 / 3.0 * 2.0 * math.cos(angle) * abs(error), 1.5 * branch

    def missing(size):
        return pull * size + spread_force(rolling, clearance, size)

    place = size_under(missing, pull * free, 0.0)
    given = scene(3, {"pin_tangential": [error, 0.0, 0.0]}, 0.0, [0.0, THIRD, 2 * THIRD],
                  **{"supports.sun": {"mass": 1.0, "rolling": rolling, "clearance": clearance}}
                  | THREE)  # fmt: skip
    found = load_sharing(given)
    moved = np.linalg.norm(found.displacement[:, 0], axis=1)
    assert moved == pytest.approx(place, rel=1e-5)
    mean = TORQUE / (3 * 0.5 * 30 * 0.8e-3 * math.cos(angle))
    approach = 2.0 * math.cos(angle) * error
    share = 1.0 - branch * approach / mean * (2.0 / 3.0) * (1.0 - place / free)
    assert found.share[:, 0] == pytest.approx(share, abs=1e-5)


def rolling(build=planar, flow=FLOWS[0], clearance=0.0, **changes):
    """A scene whose planets and sun are on rolling elements."""
    base = build(flow, **changes)
    supports = base.supports.model_dump(exclude_none=True)
    for body, elements in (("planet", ROLLERS), ("sun", BALLS)):
        supports[body].pop("bearing")
        supports[body] |= {"rolling": elements, "clearance": clearance}
    return base.replace(supports=supports)


@pytest.mark.parametrize("clearance", first(1, [1e-5, 0.0]))
@pytest.mark.parametrize("flow", [FLOWS[0], FLOWS[2]], ids=flow_name)
@pytest.mark.parametrize("build", [planar, spatial])
def test_the_energy_of_a_run_balances(build, flow, clearance):
    given = rolling(build, flow, clearance, **{"errors.pin_tangential": [-2e-5, 0.0, 0.0]})
    energy = simulate(given, 0.03, tolerance=1e-5).energy
    assert abs(energy.residual) < 1e-6 * energy.driving_work


@pytest.mark.parametrize("clearance", [0.0, 1e-5])
def test_means_of_a_run_are_those_of_statics(clearance):
    given = rolling(
        clearance=clearance,
        **{
            "errors.pin_tangential": [-2e-5, 0.0, 0.0],
            "mesh.double_pair_ratio": 1.0,
            "mesh.ramp": 0.0,
            "lubrication.friction": False,
        },
    )
    static = load_sharing(given)
    run = simulate(given, 0.02, settling=0.05)
    assert run.axes.mean_load_share == pytest.approx(static.share.mean(axis=0), rel=5e-3)
    bearings = np.concatenate([static.bearing, static.planet_bearing], axis=1).mean(axis=0)
    assert run.axes.bearing_force.mean(axis=0) == pytest.approx(bearings, rel=5e-3, abs=2.0)
    moved = static.displacement.mean(axis=0)
    assert run.axes.displacement[:, :3].mean(axis=0) == pytest.approx(moved, rel=5e-3, abs=2e-8)


def test_small_motion_of_a_planet_is_stiffer_along_its_load():
    given = rolling()
    pin = np.linalg.norm(load_sharing(given).planet_bearing, axis=2).mean()
    size = eccentricity(rolling_bearing(ROLLERS), 0.0, pin)
    outwards, across = radial_stiffness(given, "planet")
    assert outwards == pytest.approx(pin / size, rel=1e-9)
    assert across == pytest.approx(10.0 / 9.0 * pin / size, rel=1e-6)  # of a force r^(10/9)
    for model in ("planar", "spatial"):
        springs = spring_model(given, model).springs
        found = [s.stiffness for s in springs if s.kind == "planet_bearing"]
        assert found == [outwards, across] * 3


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"mass": 1.0}, "supports.sun: bearing: required"),
        ({"mass": 1.0, "bearing": 1e8, "rolling": {"balls": 9, "diameter": 8e-3}},
         "supports.sun: bearing: must be null, as rolling has its own law"),
        ({"mass": 1.0, "damping": 1e3, "rolling": {"balls": 9, "diameter": 8e-3}},
         "supports.sun: damping: must be null, as rolling has its own law"),
        ({"mass": 1.0, "rolling": {"balls": 9, "length": 8e-3}},
         "supports.sun.rolling: must have either rollers and length, or balls and diameter"),
        ({"mass": 1.0, "rolling": {"balls": 2, "diameter": 8e-3}}, "supports.sun.rolling.balls"),
    ],
)  # fmt: skip
def test_a_bearing_that_is_not_defined_is_refused_in_one_line(given, said):
    supports = {kind: {"mass": mass, "bearing": 1e8} for kind, mass in MASSES.items()}
    with pytest.raises(SceneError, match=re.escape(said)):
        planar(supports=supports | {"sun": given})
