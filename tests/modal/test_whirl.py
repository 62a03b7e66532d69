"""Whirl above a critical speed: a rotor on a soft bearing, and runs of a whole gear set."""

import cmath
import math

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.modal.springs import Spring, SpringModel
from planetary_twin_py.modal.turning import turning_terms
from planetary_twin_py.modal.whirl import growing, whirl_warning
from planetary_twin_py.model.gearbox import Gearbox

MASS, STIFFNESS = 2.0, 8e4
CRITICAL = math.sqrt(STIFFNESS / MASS)  # [rad/s]


def rotor_growth(speed, housing, turning):
    """Growth [1/s] of a rotor on one bearing; damping is at rest in the housing, or turns."""
    rows = np.eye(2)
    model = SpringModel(
        ("sun.x", "sun.y"),
        np.full(2, MASS),
        tuple(Spring("sun_bearing", STIFFNESS, row) for row in rows),
    )
    terms = turning_terms(model, speed, {}, ())
    circulating = housing * speed * np.array([[0.0, -1.0], [1.0, 0.0]])
    found = growing(model, terms, (housing + turning) * rows, circulating)
    return None if found is None else found.real


@pytest.mark.parametrize(("housing", "turning"), [(20.0, 40.0), (60.0, 20.0), (0.0, 30.0)])
def test_a_rotor_is_stable_up_to_its_threshold(housing, turning):
    """W = sqrt(k/m) (1 + c/c_r) (Genta 2005, Dynamics of Rotating Systems); beyond it the whirl
    grows as the root of m s^2 + (c + c_r) s + k = i W c_r in the housing."""
    threshold = CRITICAL * (1.0 + housing / turning)
    for speed in (0.5 * CRITICAL, 0.999 * threshold):
        assert rotor_growth(speed, housing, turning) is None
    speed, both = 1.3 * threshold, housing + turning
    root = cmath.sqrt(both**2 - 4.0 * MASS * (STIFFNESS - 1j * speed * turning))
    expected = max(((sign * root - both) / (2.0 * MASS)).real for sign in (1.0, -1.0))
    assert rotor_growth(speed, housing, turning) == pytest.approx(expected, rel=1e-9)


SOFT = {
    "gearset.held": "ring",
    "drive.output.member": "carrier",
    "supports.ring.bearing": 1e6,
    "supports.carrier.bearing": 1e6,
    "drive.speed_limit": pt.rpm(40_000),
    "backlash": 1e-3,
    "lubrication.friction": False,
}


def soft(input_speed, **changes):
    """Axes that whirl with the carrier at 17 000 rpm of the sun."""
    speed = {"input_speed": pt.rpm(input_speed)}
    return pt.load_scene("floating_sun").replace(**SOFT | speed | changes)


@pytest.mark.parametrize("dynamics", ["planar", "quasi_static_planar"])
def test_above_the_critical_speed_axes_are_as_load_sharing_says(dynamics):
    scene = soft(18_000, dynamics=dynamics)
    expected = np.linalg.norm(pt.load_sharing(scene).displacement, axis=2).mean(axis=0)
    run = pt.simulate(scene, 0.004, tolerance=1e-5)
    found = np.linalg.norm(run.axes.displacement[:, :3], axis=2)
    assert found == pytest.approx(np.broadcast_to(expected, found.shape), rel=0.05)
    assert expected[0] == pytest.approx(2.04e-6, rel=0.01)


def test_a_fast_carrier_turns_about_its_centre_of_mass():
    """Its displacement falls with the speed, as that of a rotor does (Jeffcott 1919)."""
    sizes = []
    for input_speed in (18_000, 30_000, 40_000):
        found = pt.load_sharing(soft(input_speed)).displacement[:, 2]
        sizes.append(np.linalg.norm(found, axis=1).mean())
    assert sizes[0] > sizes[1] > sizes[2]


TURNING_DAMPING = {
    "supports.ring.damping": 0.0,
    "supports.ring.mass": 3.0,
    "supports.carrier.damping": 0.0,
    "supports.planet": {"mass": 0.01, "bearing": 1e6, "damping": 3e3},
    "input_torque": 6.0,
    "mesh.double_pair_ratio": 1.0,
}


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
def test_whirl_of_a_run_grows_as_its_warning_says():
    scene = soft(25_000, **TURNING_DAMPING)
    warning = whirl_warning(Gearbox(scene), scene.operating_point)
    frequency = float(warning.split(" Hz in the frame")[0].split()[-1])
    growth = float(warning.split(" 1/s")[0].split()[-1])
    twin = pt.Twin(scene, sample_rate=2000.0, tolerance=1e-5)
    twin.set(input_torque=8.0)  # moves the equilibrium
    moved = np.concatenate([twin.advance(0.01).axes.displacement[:, 0] for _ in range(22)])
    orbit = (moved[:, 0] - 1j * moved[:, 1]) - (moved[:, 0] - 1j * moved[:, 1]).mean()
    length = round(6 / frequency * 2000.0)  # whole turns of the whirl
    turns = np.exp(-2j * math.pi * frequency * np.arange(len(orbit)) / 2000.0)
    early, late = (np.abs(np.mean((orbit * turns)[a : a + length])) for a in (100, 200))
    assert math.log(late / early) / 0.05 == pytest.approx(growth, rel=0.03)


def test_runs_and_load_sharing_warn_of_whirl_that_grows():
    scene = soft(25_000, **TURNING_DAMPING)
    with pytest.warns(pt.AccuracyWarning, match="grows with 8.9. 1/s, until teeth or clearances"):
        pt.load_sharing(scene)
    with pytest.warns(pt.AccuracyWarning, match="above a critical speed of its bearings"):
        pt.simulate(scene, 0.001)


@pytest.mark.parametrize("speed", [12_000, 18_000])
def test_damping_in_the_housing_keeps_the_axes_stable(speed):
    scene = soft(speed)
    assert whirl_warning(Gearbox(scene), scene.operating_point) == ""
