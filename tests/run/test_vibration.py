"""An accelerometer on the housing of a simulated gearbox."""

import re

import numpy as np
import pytest
from analysis.gear_sets import gear_set
from planar.moving_scenes import supports

import planetary_twin_py as pt

CARRIER = 10.0 * 7.0 / 40.0  # turns per second of 21/39/99 at 600 rpm of the sun
DAMPED = {"mesh.damping": {"law": "viscous", "damping_ratio": 0.05}}
QUIET = {"noise": 0.0}


@pytest.fixture(scope="module")
def scene():
    return gear_set((21, 39, 99), input_speed=pt.rpm(600.0), **DAMPED)


RATE = 32_768 * CARRIER  # samples a second; a number per turn which 3 does not divide


@pytest.fixture(scope="module")
def run(scene):
    """Little more than a turn of the carrier, after the vibration of the start has decayed.

    16 times the rate of the sensor: the forces of entering teeth have harmonics up to hundreds of
    kHz, and those above half the rate of the run are aliases already.
    """
    return pt.simulate(scene, 1.1 / CARRIER, sample_rate=16.0 * RATE, settling=5.0 / CARRIER)


def orders(run, time, values):
    """Amplitudes by order of the carrier, over one turn by its measured angle."""
    angle = np.interp(time, run.time, run.angle[:, run.bodies.index("carrier")])
    turn = pt.resample_by_angle(values, angle, 32_768).samples[:32_768]
    return 2.0 * np.abs(np.fft.rfft(turn)) / 32_768


def spectrum_of(scene, run, **sensor):
    found = pt.measure_vibration(scene, run, pt.Accelerometer(rate=RATE, **sensor))
    return orders(run, found.time, found.values)


def between(lines):
    """Largest line at an order that no ring force of three equal planets has."""
    return lines[:2048][np.arange(2048) % 3 != 0].max()


def test_sidebands_of_equal_planets_are_those_of_the_window(scene, run):
    """99 : 96 : 102 = 70 : 8 : 8 for cos^8, and nothing stands between multiples of 3."""
    lines = spectrum_of(scene, run, **QUIET)
    assert lines[[96, 102]] / lines[99] == pytest.approx([8 / 70, 8 / 70], rel=1e-3)
    assert between(lines) < 1e-4 * lines[99]  # whatever is there is an alias


def test_point_samples_of_the_force_have_aliases(scene, run):
    """The same window at a rate of 2048 a turn, without the filter."""
    carrier = run.angle[:, run.bodies.index("carrier")]
    place = carrier[:, None] + np.asarray(scene.gearset.planet_angles)
    force = (run.mesh_force[:, 3:] * np.cos(0.5 * place) ** 8).sum(axis=1)
    lines = orders(run, run.time[::256], force[::256])
    assert between(lines) > 1e-2 * lines[99]


def test_the_place_of_the_sensor_turns_phases_alone(scene, run):
    here, there = (spectrum_of(scene, run, angle=angle, **QUIET) for angle in (0.0, 1.0))
    assert there[96:103:3] == pytest.approx(here[96:103:3], rel=1e-3)


def test_noise_range_and_bits_belong_to_the_sensor(scene, run):
    quiet = pt.measure_vibration(scene, run, pt.Accelerometer(rate=RATE, **QUIET))
    noisy = pt.measure_vibration(scene, run, pt.Accelerometer(rate=RATE, noise=0.5))
    again = pt.measure_vibration(scene, run, pt.Accelerometer(rate=RATE, noise=0.5))
    assert np.std(noisy.values - quiet.values) == pytest.approx(0.5, rel=0.05)
    assert np.array_equal(noisy.values, again.values) and quiet.clipped == 0
    limit = 0.5 * np.abs(quiet.values).max()
    coarse = pt.Accelerometer(rate=RATE, noise=0.0, range=limit, bits=8)
    with pytest.warns(pt.AccuracyWarning, match="samples are beyond the range"):
        clipped = pt.measure_vibration(scene, run, coarse)
    assert clipped.clipped == (np.abs(quiet.values) > limit).sum() > 0
    steps = clipped.values / (2.0 * limit / 256)
    assert np.abs(clipped.values).max() <= limit
    assert steps == pytest.approx(np.round(steps), abs=1e-9)


@pytest.mark.parametrize("ratio", [3.0, 4.5])
def test_a_run_sampled_too_coarsely_is_refused(scene, run, ratio):
    sensor = pt.Accelerometer(rate=16.0 * RATE / ratio)
    with pytest.raises(ValueError, match=r"sample_rate = .* Hz: must be 4, 5, ... times the rate"):
        pt.measure_vibration(scene, run, sensor)


def test_aliases_of_a_coarse_run_are_estimated_and_warned_of(scene, run):
    """At 4 times the rate of the sensor: what stands between multiples of 3, within a half."""
    coarse = pt.simulate(scene, 1.1 / CARRIER, sample_rate=4.0 * RATE, settling=5.0 / CARRIER)
    with pytest.warns(pt.AccuracyWarning, match="ring: aliases of up to") as warned:
        lines = spectrum_of(scene, coarse, **QUIET)
    (line,) = (str(warning.message) for warning in warned)
    estimate = float(re.search(r"of up to ([0-9.e-]+) of the largest line", line)[1])
    found = between(lines) / lines[:2048].max()
    assert found > 1e-4 and estimate > 1e-4
    assert 0.5 < estimate / found < 2.0
    assert "should be at most 0.0001" in line


@pytest.mark.filterwarnings("error::planetary_twin_py.AccuracyWarning")
def test_a_fine_run_is_not_warned_of(scene, run):
    spectrum_of(scene, run, **QUIET)


@pytest.fixture(scope="module")
def rig():
    """17/37/91 teeth whose ring moves on its bearing, in little more than three turns."""
    scene = gear_set(
        (17, 37, 91), input_speed=pt.rpm(3000.0), input_torque=20.0, dynamics="planar",
        backlash=1e-4, supports=supports(),
    )  # fmt: skip
    turn = 108.0 / 17.0 / 50.0  # of the carrier [s]
    return scene, pt.simulate(scene, 3.3 * turn, sample_rate=400_000.0, settling=3.0 * turn)


def ring_orders(scene, run, rate, **sensor):
    """Amplitudes of the acceleration of the ring at a third of an order, by measured angle."""
    own = pt.Accelerometer(rate=rate, path={"law": "rigid", "radius": 0.1}, **QUIET, **sensor)
    found = pt.measure_vibration(scene, run, own)
    angle = np.interp(found.time, run.time, run.angle[:, run.bodies.index("carrier")])
    turns = pt.resample_by_angle(found.values, angle, 8192).samples[: 3 * 8192]
    return 2.0 * np.abs(np.fft.rfft(turns)) / len(turns)


@pytest.mark.filterwarnings("ignore:ring. aliases")
@pytest.mark.parametrize("rate", [16_000.0, 50_000.0])
def test_a_rigid_ring_has_the_orders_of_its_teeth_alone(rig, rate):
    """One wave: orders 91 l -+ 1 that three planets divide; 91 would be an alias."""
    scene, run = rig
    lines = ring_orders(scene, run, rate)
    for order in (90, 183, 363):
        assert lines[3 * order] > 0.1
    allowed = np.zeros(3 * 400, dtype=bool)
    for harmonic in range(1, 5):
        for order in (91 * harmonic - 1, 91 * harmonic + 1):
            if order % 3 == 0:
                allowed[3 * order - 1 : 3 * order + 2] = True
    rest = np.where(allowed, 0.0, lines[: 3 * 400])
    assert rest[10:].max() < 1e-3 * lines[3 * 363]
    assert lines[3 * 91] < 1e-3 * lines[3 * 363]


@pytest.mark.filterwarnings("ignore:ring. aliases")
@pytest.mark.parametrize("rate", [16_000.0, 50_000.0])
@pytest.mark.parametrize("direction, axis", [("radial", 0.3), ("tangential", 0.3 + 0.5 * np.pi)])
def test_a_rigid_ring_is_felt_as_its_orbit_bends(rig, direction, axis, rate):
    """The second difference of the orbit in the housing, which the core itself turns there."""
    scene, run = rig
    along = run.axes.orbit[:, 1] @ np.array([np.cos(axis), np.sin(axis)])
    felt = np.diff(along, 2) * 400_000.0**2
    carrier = run.angle[1:-1, run.bodies.index("carrier")]
    turns = pt.resample_by_angle(felt, carrier, 65_536).samples[: 3 * 65_536]
    expected = 2.0 * np.abs(np.fft.rfft(turns)) / len(turns)
    found = ring_orders(scene, run, rate, angle=0.3, direction=direction)
    for order in (90, 183, 363):
        assert found[3 * order] == pytest.approx(expected[3 * order], rel=0.01)


@pytest.mark.parametrize(
    "sensor, line",
    [
        ({"path": {"law": "rigid"}}, "sensor.path.law = 'rigid': requires dynamics = planar"),
    ],
)
def test_a_sensor_that_does_not_fit_the_scene_is_refused(scene, run, sensor, line):
    with pytest.raises(ValueError, match=line):
        pt.measure_vibration(scene, run, pt.Accelerometer(**sensor))


def test_a_run_shorter_than_the_filters_is_refused(scene):
    short = pt.simulate(scene, 1e-4, sample_rate=102_400.0)
    with pytest.raises(ValueError, match="must be longer than the filters of the sensor"):
        pt.measure_vibration(scene, short)
