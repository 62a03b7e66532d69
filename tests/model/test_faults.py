"""Where a faulty tooth shows: at the instants and orders that the tooth numbers give."""

import math

import numpy as np
import pytest
from tiers import first

import planetary_twin_py as pt

PAPER = pt.load_scene("paper")
PSI = np.array(PAPER.gearset.planet_angles)
ZS, ZP, ZR = 30, 20, 70
MESH_FREQUENCY = 50.0  # [Hz]
# Slow and without friction, so that a mesh follows its stiffness at once.
CALM = PAPER.replace(
    **{
        "lubrication.friction": False,
        "mesh.damping.law": "viscous",
        "mesh.damping.damping_ratio": 1.0,
        "drive.input.coupling_stiffness": 1e6,
        "drive.output.coupling_stiffness": 1e6,
        "input_speed": 2 * math.pi * MESH_FREQUENCY / ZS,
        "input_torque": 6.3,
    }
)
CRACK = {"kind": "crack", "stiffness_loss": 0.5}
DURATION = 2.1 * max(ZS, ZP, ZR) / MESH_FREQUENCY


def disturbances(fault, scene=CALM, duration=DURATION, method="auto"):
    """Times [s], and the change of each mesh's transmission error [m] that `fault` makes."""
    healthy = pt.simulate(scene, duration, 5000.0, method)
    faulty = pt.simulate(scene.replace(faults=[fault]), duration, 5000.0, method)
    return healthy.time, faulty.dte - healthy.dte


def passages(time, change):
    """Middles of the stretches over which a mesh is changed the most."""
    felt = np.abs(change) > 0.5 * np.abs(change).max()
    edges = np.flatnonzero(np.diff(np.concatenate([[0], felt, [0]])))
    middles = (time[edges[::2]] + time[np.minimum(edges[1::2], len(time)) - 1]) / 2
    return np.array([np.mean(group) for group in _grouped(middles, 3 / MESH_FREQUENCY)])


def _grouped(values, gap):
    return np.split(values, np.flatnonzero(np.diff(values) > gap) + 1)


def assert_passes(found, first, period):
    """Passages lie within a mesh cycle of first + n * period, one for each n."""
    expected = first % period + period * np.arange(math.ceil(DURATION / period))
    inside = expected[(expected > 2 / MESH_FREQUENCY) & (expected < DURATION - 2 / MESH_FREQUENCY)]
    assert len(inside) >= 1
    for instant in inside:
        assert np.abs(found - instant).min() < 1 / MESH_FREQUENCY


@pytest.mark.parametrize("planet", [0, 1, 2])
@pytest.mark.parametrize("tooth", first(1, [7, 0]))
def test_a_tooth_of_the_sun_meets_each_planet_as_the_sun_turns(planet, tooth):
    time, change = disturbances(CRACK | {"gear": "sun", "tooth": tooth})
    found = passages(time, change[:, planet])
    sun_speed = 2 * math.pi * MESH_FREQUENCY / ZS  # against the carrier
    turn = 2 * math.pi / sun_speed
    assert_passes(found, (PSI[planet] - PSI[0]) / sun_speed + tooth / MESH_FREQUENCY, turn)
    assert np.all(np.abs(np.diff(found) - turn) < 1 / MESH_FREQUENCY)


@pytest.mark.parametrize("planet", [0, 1, 2])
def test_a_tooth_of_the_ring_meets_each_planet_as_the_ring_turns(planet):
    time, change = disturbances(CRACK | {"gear": "ring", "tooth": 5})
    found = passages(time, change[:, 3 + planet])
    ring_speed = 2 * math.pi * MESH_FREQUENCY / ZR  # backwards
    first = (PSI[0] - PSI[planet]) / ring_speed + 5.5 / MESH_FREQUENCY
    assert_passes(found, first, 2 * math.pi / ring_speed)


@pytest.mark.parametrize("planet", [1, 3])
def test_tooth_of_a_planet_meets_sun_and_ring_half_a_turn_apart(planet):
    time, change = disturbances(CRACK | {"gear": "planet", "planet": planet, "tooth": 3})
    size = np.abs(change).max(axis=0)
    assert set(np.argsort(size)[-2:]) == {planet - 1, planet + 2}
    sun, ring = (passages(time, change[:, mesh]) for mesh in (planet - 1, planet + 2))
    turn = ZP / MESH_FREQUENCY
    assert np.all(np.abs(np.diff(sun) - turn) < 1 / MESH_FREQUENCY)
    assert np.abs(np.abs(sun[1] - ring).min() - turn / 2) < 1 / MESH_FREQUENCY


@pytest.mark.parametrize(
    "method, trace",
    [pytest.param("rosenbrock", 1e-14, marks=pytest.mark.exhaustive), ("auto", 1e-9)],
)
def test_a_worn_flank_shows_on_its_own_side_only(method, trace):
    """Rosenbrock's method takes the same steps with and without the fault; collocation does not."""
    wear = {"kind": "wear", "gear": "sun", "depth": "1 um"}
    _, drive = disturbances(wear | {"flank": "drive"}, method=method)
    _, coast = disturbances(wear | {"flank": "coast"}, method=method)
    assert np.abs(drive).max() > 5e-7
    assert np.abs(coast).max() < trace
    backwards = CALM.replace(input_torque=-6.3)
    _, drive = disturbances(wear | {"flank": "drive"}, backwards, method=method)
    _, coast = disturbances(wear | {"flank": "coast"}, backwards, method=method)
    assert np.abs(drive).max() < trace
    assert np.abs(coast).max() > 5e-7


def change_alone(fault):
    """Change of a sun mesh's transmission error [m] while its faulty tooth 1 is alone in contact.

    Slow enough that the machines cease to swing on their shafts meanwhile.
    """
    slow = CALM.replace(
        **{"mesh.double_pair_ratio": 1.0, "input_speed": 2 * math.pi * 2.0 / ZS, "faults": []}
    )
    time, change = disturbances(fault | {"gear": "sun", "tooth": 1}, slow, 0.7)
    cycles = 2.0 * time
    return change[(cycles > 1.0) & (cycles < 1.2), 0].mean()


def test_a_mesh_yields_by_two_thirds_of_the_wear_of_a_tooth():
    """Three planets in parallel, each two springs k in series: what one lacks the others bear.

    The sum of both deflections grows by a third of the depth w, the worn mesh by w less w/3.
    """
    assert change_alone({"kind": "wear", "depth": "0.3 um"}) == pytest.approx(0.2e-6, rel=0.01)


def test_a_mesh_of_half_the_stiffness_yields_by_half_as_much():
    """Compliances of the three planets 3/k, 2/k, 2/k: the cracked one bears 3/4 of its share."""
    force = 6.3 / 3 / (0.012 * math.cos(math.radians(21.34)))
    assert change_alone(CRACK) == pytest.approx(0.5 * force / 2e8, rel=0.01)


def test_a_spall_is_felt_where_it_is_on_the_path():
    spall = {"kind": "spall", "gear": "sun", "tooth": 3, "stiffness_loss": 0.5}
    time, change = disturbances(spall | {"begin": 0.0, "end": 0.1})
    felt = time[np.abs(change[:, 0]) > 0.5 * np.abs(change[:, 0]).max()]
    cycles = felt * MESH_FREQUENCY % ZS - 3
    assert cycles.min() > 0.0 and cycles.max() < 0.2


@pytest.mark.parametrize(
    "fault, mesh, order",
    [
        ({"gear": "sun"}, 0, 1 / ZS),
        ({"gear": "ring"}, 3, 1 / ZR),
        ({"gear": "planet"}, 0, 1 / ZP),
        ({"gear": "planet"}, 3, 1 / ZP),
    ],
    ids=str,
)
def test_sidebands_are_at_the_orders_of_the_faulty_gear(fault, mesh, order):
    """Relative to the carrier a tooth of the sun returns every Zs mesh cycles, and so on."""
    cycles = round(1 / order)
    rate, turns = 64 * MESH_FREQUENCY, 4
    scene = CALM.replace(faults=[CRACK | fault])
    run = pt.simulate(scene, (turns + 1) * cycles / MESH_FREQUENCY, rate)
    dte = run.dte[-turns * 64 * cycles :, mesh]
    spectrum = np.abs(np.fft.rfft(dte - dte.mean())) / len(dte)
    bins = np.arange(len(spectrum)) / (turns * cycles)  # orders of the meshing frequency
    near = (bins > 0.5) & (bins < 1.5) & (np.abs(bins - 1.0) > 0.4 * order)
    on_lines = near & (np.abs(bins / order - np.round(bins / order)) < 1e-6)
    between = near & ~on_lines
    # Speed control lets the mean speed wander by little: lines are narrow, not single bins.
    assert spectrum[on_lines].mean() > 20 * spectrum[between].mean()
