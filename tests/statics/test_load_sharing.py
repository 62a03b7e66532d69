"""Static load sharing against closed forms for equal planets with constant mesh stiffness.

With eps the approach of a branch sun-planet-ring by an error, K its stiffness and F the mean mesh
force, F_i = F + K (eps_i - mean of eps) for axes that are held; a sun without bearing takes the
first harmonic of eps over the planets away.
"""

import math

import numpy as np
import pytest
from planar.published_set import MESH, PIN, TORQUE, scene

from planetary_twin_py import load_scene, simulate
from planetary_twin_py.statics.load_sharing import load_sharing

HELD, FREE = 1e14, 0.0
ANGLE = math.radians(21.34)
BRANCH = 1.0 / (2.0 / MESH + 4.0 * math.cos(ANGLE) ** 2 / PIN)
# Teeth with the same base radius of the sun, of which three or six planets can be spaced equally.
THREE = {"gearset.teeth": {"sun": 30, "planet": 21, "ring": 72}}
SIX = {"gearset.teeth": {"sun": 60, "planet": 24, "ring": 108}, "gearset.module": 4e-4}
BASE_RADIUS = 0.5 * 30 * 0.8e-3 * math.cos(ANGLE)


def centrifugal_stiffness(given):
    """m Omega^2 of a planet [N/m], by the speeds of Willis' equation."""
    teeth, speed = given.gearset.teeth, given.operating_point.input_speed
    member, held = given.drive.input.member, given.gearset.held
    size = {"sun": teeth.sun, "ring": teeth.ring, "carrier": teeth.sun + teeth.ring}
    if held == "carrier":
        return 0.0
    return given.supports.planet.mass * (speed * size[member] / size["carrier"]) ** 2


def mean_force(planets):
    return TORQUE / (planets * BASE_RADIUS)


def shares(planets, approach, free, angles=None):
    """Closed form; `approach` of each branch [m]."""
    psi = np.array(angles or 2.0 * np.pi * np.arange(planets) / planets)
    rest = approach - approach.mean()
    if free:
        first = (rest * np.exp(1j * psi)).sum() * 2.0 / planets
        rest = rest - (first * np.exp(-1j * psi)).real
    return 1.0 + BRANCH * rest / mean_force(planets)


@pytest.mark.parametrize("sun", [HELD, FREE])
@pytest.mark.parametrize("planets", [4, 5])
def test_pin_that_lags_carries_less_and_a_free_sun_evens_it_out(planets, sun):
    error = -1e-5
    found = load_sharing(scene(planets, {"pin_tangential": [error] + [0.0] * (planets - 1)}, sun))
    approach = np.zeros(planets)
    approach[0] = -2.0 * math.cos(ANGLE) * error
    expected = shares(planets, approach, sun == FREE)
    assert found.share[0] == pytest.approx(expected, rel=1e-6)
    assert found.share.std(axis=0) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(
    "errors, closing",
    [
        ({"pin_tangential": [-1e-4, 0.0, 0.0]}, lambda s, r: 1e-4 * (math.cos(s) + math.cos(r))),
        ({"pin_radial": [1e-4, 0.0, 0.0]}, lambda s, r: 1e-4 * (math.sin(r) - math.sin(s))),
        ({"planet_thickness": [1e-4, 0, 0]}, lambda s, r: 5e-5 * (math.cos(s) + math.cos(r))),
    ],
    ids=["tangential pin", "radial pin", "thickness"],
)
def test_unequal_working_angles_have_closed_form_of_both_angles(errors, closing):
    """28.1 deg at the sun and 17.2 deg at the ring: the force of a pin has a radial part, too."""
    stiffness, pin = {"sun_planet": 2e9, "planet_ring": 3e9}, 5e9
    stage = load_scene("reference_gearbox_stage")
    rigid = {"mass": 1000.0, "bearing": HELD}
    supports = dict.fromkeys(("sun", "ring", "carrier"), rigid)
    given = stage.replace(
        **{f"mesh.{kind}_stiffness": k for kind, k in stiffness.items()},
        **{
            "mesh.stiffness": "given",
            "mesh.double_pair_ratio": 1.0,
            "mesh.ramp": 0.0,
            "input_torque": -4e6,  # the sun's torque is positive
            "backlash": 1e-3,
            "supports": {**supports, "planet": {"mass": 1000.0, "bearing": pin}},
            "errors": errors,
        },
    )
    sun, ring = (mesh.pressure_angle for mesh in given.gearset.geometry.meshes)
    assert math.degrees(sun - ring) > 10.0
    compliance = sum(1.0 / k for k in stiffness.values())
    compliance += (math.cos(sun) + math.cos(ring)) ** 2 / pin
    compliance += (math.sin(sun) - math.sin(ring)) ** 2 / pin
    mean = 4e6 * 19 / (19 + 56) / 3 / given.gearset.geometry.sun.base_radius
    change = closing(sun, ring) / compliance / mean
    expected = 1.0 + np.array([2.0, -1.0, -1.0]) / 3.0 * change
    found = load_sharing(given).share
    assert abs(expected - 1.0).max() > 5e-3
    assert found == pytest.approx(np.tile(expected, (len(found), 1)), rel=1e-5)


# Shares of the torque, float of the sun [um] and forces on the pins [N], for one pin 10 um behind.
TABLE = {
    4: ([1.07393, 0.92607, 1.07393, 0.92607], 9.314, [2819, 2431, 2819, 2431]),
    5: ([1.14787, 0.88037, 1.04569, 1.04569, 0.88037], 7.452, [2410, 1849, 2196, 2196, 1849]),
}


@pytest.mark.parametrize("planets", TABLE)
def test_figures_of_another_model_with_three_freedoms_a_body(planets):
    found = load_sharing(scene(planets, {"pin_tangential": [-1e-5] + [0.0] * (planets - 1)}, FREE))
    share, floated, pins = TABLE[planets]
    assert found.share[0] == pytest.approx(share, abs=6e-6)
    assert 1e6 * math.hypot(*found.displacement[0, 0]) == pytest.approx(floated, abs=6e-4)
    assert np.linalg.norm(found.planet_bearing[0], axis=1) == pytest.approx(pins, abs=0.6)


@pytest.mark.parametrize("sun", [HELD, FREE])
def test_three_planets_share_evenly_only_with_a_free_sun(sun):
    paper = load_scene("paper").gearset.planet_angles
    third = 2.0 * math.pi / 3.0
    equal = scene(3, {"pin_tangential": [-1e-5, 0.0, 0.0]}, sun, [0.0, third, 2 * third],
                  **THREE)  # fmt: skip
    found = load_sharing(equal)
    assert (found.share.max() < 1.0 + 1e-6) == (sun == FREE)
    uneven = load_sharing(scene(3, None, FREE, list(paper)))
    assert uneven.share[0] == pytest.approx([0.97537, 1.01231, 1.01231], abs=6e-6)


def test_thick_teeth_and_leading_pins_carry_their_approach():
    thicker, ahead = 4e-6, -3e-6
    found = load_sharing(
        scene(4, {"planet_thickness": [0, thicker, 0, 0], "pin_tangential": [0, 0, ahead, 0]}, HELD)
    )
    cosine = math.cos(ANGLE)
    expected = shares(4, np.array([0.0, thicker * cosine, -2.0 * cosine * ahead, 0.0]), free=False)
    assert found.share[0] == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize(
    ("planets", "error", "expected"),
    [
        (4, -2e-4, [0.5, 0.0, 0.5, 0.0]),
        (5, -2e-4, [0.44721, 0.0, 0.27639, 0.27639, 0.0]),
        (6, -4e-4, [0.5, 0.0, 0.0, 0.5, 0.0, 0.0]),
        (4, 2e-4, [0.0, 0.5, 0.0, 0.5]),
        (5, 2e-4, [0.0, 0.36180, 0.13820, 0.13820, 0.36180]),
        (6, 2e-4, [0.0, 0.27778, 0.16667, 0.11111, 0.16667, 0.27778]),
    ],
)
def test_large_errors_load_the_planets_that_balance_the_sun(planets, error, expected):
    errors = {"pin_tangential": [error] + [0.0] * (planets - 1)}
    changes = {"backlash": 1e-3} | (SIX if planets == 6 else {})
    found = load_sharing(scene(planets, errors, FREE, **changes))
    assert found.share[0] / planets == pytest.approx(expected, abs=1e-5)


@pytest.mark.parametrize(
    ("clearance", "float_um", "share"),
    [(5e-6, 9.984, 1.17686), (1e-5, 13.728, 1.13228), (4e-5, 24.838, 1.0)],
)
def test_a_sun_floats_within_its_bearing_clearance_alone(clearance, float_um, share):
    third = 2.0 * math.pi / 3.0
    given = scene(3, {"pin_tangential": [-2e-5, 0.0, 0.0]}, 1e8, [0.0, third, 2 * third],
                  **{"supports.sun.clearance": clearance} | THREE)  # fmt: skip
    found = load_sharing(given)
    assert 1e6 * math.hypot(*found.displacement[0, 0]) == pytest.approx(float_um, abs=6e-4)
    assert found.share[0, 0] == pytest.approx(share, abs=6e-6)


@pytest.mark.parametrize(
    ("backlash", "coast"), [(2e-7, 336.0), (5e-6, 174.0), (1.014e-5, None), (1.016e-5, 0.0)]
)
def test_a_floating_sun_closes_the_play_until_flanks_touch(backlash, coast):
    paper = load_scene("paper").gearset.planet_angles
    found = load_sharing(
        scene(3, {"pin_tangential": [-2e-5, 0.0, 0.0]}, FREE, list(paper), backlash=backlash)
    )
    second = found.mesh_force[0, 1, 1]
    assert found.both_flanks == (backlash < 1.015e-5)
    if coast is not None:
        assert second == pytest.approx(coast, abs=0.6)
    if backlash == 2e-7:
        assert found.mesh_force[0, 0, :3] == pytest.approx([1996.0, 2175.0, 1802.0], abs=0.6)


def test_runout_of_a_free_sun_leaves_the_loads_even():
    size = 7e-6
    found = load_sharing(
        scene(3, None, FREE, **THREE | {"mesh.runout.sun": size, "backlash": 1e-3})
    )
    assert found.share == pytest.approx(1.0, abs=1e-7)
    orbit = found.displacement[:, 0] @ [1.0, 1.0j]
    assert np.abs(orbit) == pytest.approx(size, rel=1e-6)
    turned = np.unwrap(np.angle(orbit)) - np.angle(orbit[0])
    # The carrier is held, so in its frame the sun turns as its motor does.
    assert turned == pytest.approx(2.0 * np.pi * (found.turns - found.turns[0]), abs=1e-6)


def test_a_free_sun_follows_an_offset_of_the_ring():
    size, angle = 5e-6, 0.4
    errors = {"ring_offset": {"size": size, "angle": angle}}
    found = load_sharing(scene(3, errors, FREE, **THREE))
    assert found.share == pytest.approx(1.0, abs=1e-7)
    assert np.hypot(*found.displacement[0, 0]) == pytest.approx(size, rel=1e-4)


def test_equally_displaced_pins_are_a_displaced_carrier():
    size, angle = 5e-6, 0.4
    third = 2.0 * math.pi / 3.0
    pins = {
        "pin_radial": [size * math.cos(angle - third * i) for i in range(3)],
        "pin_tangential": [size * math.sin(angle - third * i) for i in range(3)],
    }
    by_pins = load_sharing(scene(3, pins, HELD, **THREE))
    offset = {"carrier_offset": {"size": size, "angle": angle}}
    by_carrier = load_sharing(scene(3, offset, HELD, **THREE))
    assert by_pins.mesh_force == pytest.approx(by_carrier.mesh_force, rel=1e-6, abs=1e-3)


def test_held_axes_are_those_of_very_stiff_bearings():
    errors = {"pin_tangential": [-8e-6, 0.0, 3e-6], "planet_thickness": [0.0, 2e-6, 0.0]}
    stiff = scene(3, errors, HELD, **THREE | {"supports.planet.bearing": 1e14})
    held = scene(3, errors, HELD, **THREE).replace(supports=None)
    assert load_sharing(held).share == pytest.approx(load_sharing(stiff).share, abs=1e-4)


@pytest.mark.parametrize("member", ["sun", "ring", "carrier"])
def test_torques_of_sun_ring_and_carrier_add_up_to_nothing(member):
    held = {"sun": "ring", "ring": "carrier", "carrier": "sun"}[member]
    out = ({"sun", "ring", "carrier"} - {member, held}).pop()
    pins = [-2e-5, 0.0, 1e-5, 0.0]
    turning = scene(4, {"pin_tangential": pins}, 1e7,
                    **{"gearset.held": held, "drive.input.member": member,
                       "drive.output.member": out})  # fmt: skip
    for given in (turning, turning.replace(input_speed=0.0)):
        found = load_sharing(given)
        gears = given.gearset.geometry
        net = found.mesh_force[:, 0] - found.mesh_force[:, 1]
        sun = net[:, :4].sum(axis=1) * gears.sun.base_radius
        ring = net[:, 4:].sum(axis=1) * gears.ring.base_radius
        # The centrifugal force of a planet points away from the axis, wherever its pin yields to.
        across = found.planet_bearing[:, :, 1]
        outwards = centrifugal_stiffness(given) * (np.array(pins) + across / PIN)
        carrier = (across - outwards).sum(axis=1) * gears.centre_distance
        torque = {"sun": sun, "ring": ring, "carrier": -carrier}
        assert np.abs(sun + ring - carrier) == pytest.approx(0.0, abs=1e-7 * TORQUE)
        assert torque[member] == pytest.approx(TORQUE, rel=1e-7)
    # Bearings carry what the meshes push all bodies by, which together is nothing.
    assert found.bearing.sum(axis=1) == pytest.approx(0.0, abs=1e-5)


def test_turning_the_whole_set_changes_no_force():
    step = 2.0 * math.pi / 100
    given = [0.0, 24 * step, 50 * step, 77 * step]
    errors = {"pin_tangential": [-2e-5, 5e-6, 0.0, 0.0]}
    there = load_sharing(scene(4, errors, 1e7, given))
    here = load_sharing(scene(4, errors, 1e7, [angle + 0.7 for angle in given]))
    assert here.mesh_force == pytest.approx(there.mesh_force, rel=1e-7)


SMALL = 1e-2  # so that deflection and play hardly move teeth on in the mesh cycle
ERRORS = {
    "pin_radial": [4e-8, 0.0, -3e-8],
    "pin_tangential": [-6e-8, 2e-8, 0.0],
    "planet_thickness": [0.0, 3e-8, -2e-8],
    "sun_runout_phase": 0.7,
    "ring_runout_phase": -1.1,
    "planet_runout_phases": [0.0, 2.0, -0.4],
    "ring_offset": {"size": 5e-8, "angle": 0.3},
    "carrier_offset": {"size": 4e-8, "angle": -1.2},
}
RUNOUT = {"sun": 4e-8, "planet": 3e-8, "ring": 5e-8}


def with_errors(held, errors, **changes):
    """Held axes, members stiff in torsion, no friction."""
    third, out = 2.0 * math.pi / 3.0, {"carrier": "ring", "ring": "carrier"}[held]
    return scene(3, errors, HELD, [0.4, 0.4 + third, 0.4 + 2.0 * third], **THREE | {
        "gearset.held": held,
        "drive.output.member": out,
        "lubrication.friction": False,
        "drive.input.coupling_stiffness": 1e9,
        "drive.output.coupling_stiffness": 1e9,
    } | changes).replace(supports=None)  # fmt: skip


@pytest.mark.parametrize("held", ["carrier", "ring"])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_quasi_static_running_with_held_axes_has_the_same_forces(held, sign):
    given = with_errors(held, ERRORS, dynamics="quasi_static", input_torque=sign * SMALL * TORQUE,
                        backlash=1e-6,
                        **{"mesh.double_pair_ratio": 1.75, "mesh.ramp": 0.03,
                           "mesh.runout": RUNOUT,
                           "mesh.sun_planet_error.amplitudes": [1e-8]})  # fmt: skip
    result = simulate(given, duration=0.05, sample_rate=2000.0, tolerance=1e-8)
    turns = result.time * given.operating_point.input_speed / (2.0 * math.pi)
    found = load_sharing(given, turns)
    net = found.mesh_force[:, 0] - found.mesh_force[:, 1]
    mean = np.abs(result.mesh_force).mean()
    assert np.ptp(result.mesh_force, axis=0).min() > 0.2 * mean
    assert net == pytest.approx(result.mesh_force, abs=3e-3 * mean)
