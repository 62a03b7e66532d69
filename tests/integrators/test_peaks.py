"""Peaks between the nodes of steps are those that dense samples show."""

import numpy as np
import pytest

import planetary_twin_py as pt

PAPER = pt.load_scene("paper")
TOLERANCE, RATE = 1e-4, 1e7  # [-], [Hz]
PEAKS = ("dte_peak", "mesh_force_peak")


def scene_at(speed, ramp):
    """At a speed [rpm], with this share of a mesh cycle between stiffnesses."""
    return PAPER.replace(**{"input_speed": pt.rpm(speed), "mesh.ramp": ramp})


# Overdamped: what the edge of a stiffness excites decays within a fraction of the step after it.
OVERDAMPED = PAPER.replace(
    **{
        "gearset.teeth": {"sun": 40, "planet": 30, "ring": 100},
        "gearset.planet_angles": (0.0, np.pi),
        "gearset.held": "ring",
        "drive.input.member": "carrier",
        "drive.output.member": "sun",
        "drive.output.port": "torque",
        "mesh.sun_planet_stiffness": 1.3885e8,
        "mesh.planet_ring_stiffness": 8.491e7,
        "mesh.double_pair_ratio": 1.0631,
        "mesh.ramp": 0.0,
        "mesh.runout": {"sun": "2 um"},
        "lubrication.lambda_ratio": "computed",
        "oil_temperature": 286.85,
        "backlash": 2.2e-6,
        "input_speed": 0.48565,
        "input_torque": -10.608,
    }
)


def assert_equals_samples(statistics, dte, force):
    """Peaks of every mesh differ by less than the tolerance of the largest one."""
    for name, samples in zip(PEAKS, (dte, force), strict=True):
        dense = np.abs(samples).max(axis=0)
        assert statistics[name] == pytest.approx(dense, abs=TOLERANCE * dense.max())


@pytest.mark.parametrize(("speed", "ramp"), [(300.0, 0.03), (1000.0, 0.03), (1000.0, 0.1)])
def test_peaks_are_those_of_dense_samples_within_the_tolerance(speed, ramp):
    run = pt.simulate(scene_at(speed, ramp), 0.004, RATE, "march", TOLERANCE)
    assert_equals_samples(run.mesh, run.dte, run.mesh_force)


# Meshes whose force does not jump to its peak, which samples would miss.
@pytest.mark.parametrize(
    ("scene", "meshes"), [(OVERDAMPED, [0, 1, 2]), (scene_at(60.0, 0.0), [1, 2, 5])]
)
def test_peaks_soon_after_an_edge_are_those_of_dense_samples(scene, meshes):
    run = pt.simulate(scene, 0.02, RATE, "march", TOLERANCE)
    dense = np.abs(run.mesh_force).max(axis=0)[meshes]
    peaks = run.mesh["mesh_force_peak"][meshes]
    assert peaks == pytest.approx(dense, abs=TOLERANCE * dense.max())


def test_peaks_of_short_windows_are_those_of_dense_samples():
    twin = pt.Twin(scene_at(1000.0, 0.03), sample_rate=RATE, tolerance=TOLERANCE)
    before = twin.advance(5e-4).waveform
    for _ in range(8):
        window = twin.advance(5e-4)
        now = window.waveform
        # The last sample before is that of the start.
        dte, force = (
            np.vstack([old[-1:], new])
            for old, new in ((before.dte, now.dte), (before.mesh_force, now.mesh_force))
        )
        assert_equals_samples(window.mesh, dte, force)
        before = now


def test_peaks_of_repeated_mesh_cycles_are_those_of_computed_ones():
    repeated, computed = (
        pt.simulate(scene_at(1000.0, 0.1), 0.05, 50_000.0, method, TOLERANCE, settling=4.0)
        for method in ("auto", "march")
    )
    assert repeated.stats.repeated_steps > 0
    for name in PEAKS:
        largest = computed.mesh[name].max()
        assert repeated.mesh[name] == pytest.approx(computed.mesh[name], abs=TOLERANCE * largest)


@pytest.mark.parametrize(("torque", "ripple"), [(1.0, 5.0), (3.0, 5.0)])
def test_peaks_in_wide_backlash_are_those_of_the_other_method(torque, ripple):
    """The tolerance is relative to a deflection of which half the backlash is nearly all."""
    scene = PAPER.replace(
        input_speed="4600 rpm", backlash="100 um", input_torque=torque, torque_ripple=ripple
    )
    run = pt.simulate(scene, 0.004, method="march", tolerance=TOLERANCE)
    other = pt.simulate(scene, 0.004, method="rosenbrock", tolerance=1e-7)
    exact = other.mesh["mesh_force_peak"]
    assert run.mesh["mesh_force_peak"] == pytest.approx(exact, abs=TOLERANCE * exact.max())
