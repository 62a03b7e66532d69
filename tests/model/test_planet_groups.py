"""Planets with the same motion: their groups, and equal results if one of each is integrated."""

import math

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.model.layout import Layout
from planetary_twin_py.run.engine import Engine

PAPER = pt.load_scene("paper")
TOLERANCE = 1e-6
# Runout of the sun, too small for any result, that makes the motion of every planet different.
APART = {"mesh.runout.sun": 1e-16}
LOSSES = {
    "losses.planet_bearing": {"mean_diameter": "10 mm", "f0": 8.0, "f1": 1e-3},
    "losses.sun_bearing": {"mean_diameter": "25 mm"},
    "losses.churning": {"fill": 0.3, "gap": "5 mm", "ring": "32 mm"},
    "lubrication.rolling": "goksem_hargreaves",
}
QUANTITIES = (
    "angle", "speed", "dte", "mesh_force", "film_thickness", "lambda_ratio", "boundary_friction",
    "viscous_friction", "power_loss", "mesh_power",
)  # fmt: skip


def evenly(planets, **changes):
    """The paper's gears with planets in equal distances, each under the paper's load."""
    angles = tuple(2 * math.pi * k / planets for k in range(planets))
    return PAPER.replace(
        **{"gearset.planet_angles": angles, "input_torque": 21.0 * planets, **changes}
    )


def returning(planets):
    """24/12/48 teeth, whose planets have their own teeth at the sun after half a turn."""
    return evenly(planets, **{"gearset.teeth": {"sun": 24, "planet": 12, "ring": 48}})


@pytest.mark.parametrize(
    "scene, group",
    [
        (PAPER, (0, 1, 2)),
        (pt.load_scene("wind_turbine_stage"), (0, 0, 0)),
        (evenly(2), (0, 0)),
        (evenly(4), (0, 1, 0, 1)),
        (evenly(5), (0, 0, 0, 0, 0)),
        (evenly(5, **APART), (0, 1, 2, 3, 4)),
        (returning(4), (0, 0, 0, 0)),
    ],
    ids=lambda value: None if isinstance(value, tuple) else value.name,
)
def test_planets_in_phase_form_a_group(scene, group):
    assert Layout(scene).groups.group == group
    assert sum(Layout(scene).groups.sizes) == len(group)


def fault(gear, **changes):
    return {"faults": [{"kind": "crack", "gear": gear, "stiffness_loss": 0.3, **changes}]}


@pytest.mark.parametrize(
    "scene, changes, group",
    [
        (evenly(5), fault("planet", planet=2), (0, 1, 0, 0, 0)),
        (evenly(4), fault("planet", planet=1), (0, 1, 2, 1)),
        (evenly(5), fault("sun"), (0, 1, 2, 3, 4)),
        (evenly(5), fault("ring"), (0, 1, 2, 3, 4)),
        (evenly(5), {"mesh.runout.ring": 1e-6}, (0, 1, 2, 3, 4)),
        (evenly(5), {"mesh.runout.planet": 1e-6}, (0, 1, 2, 3, 4)),
        (evenly(5), {"mesh.sun_planet_error": {"amplitudes": [1e-6]}}, (0, 0, 0, 0, 0)),
        (returning(2), {"mesh.runout.planet": 1e-6}, (0, 0)),
        (returning(4), {"mesh.runout.planet": 1e-6}, (0, 1, 0, 1)),
    ],
    ids=str,
)
def test_different_teeth_split_groups_unless_same_teeth_return(scene, changes, group):
    assert Layout(scene.replace(**changes)).groups.group == group


def test_one_planet_of_each_group_is_integrated():
    for scene, groups in ((evenly(5), 1), (evenly(4), 2), (evenly(5, **APART), 5)):
        train = Engine(scene, 1e-4).train
        assert train.meshes == 2 * groups and train.bodies == groups + 4


def assert_equal_results(one, every):
    """Compare all quantities of two results, to within the tolerances of both runs."""
    assert one.bodies == every.bodies and one.meshes == every.meshes
    for name in QUANTITIES:
        mine, full = getattr(one, name), getattr(every, name)
        assert mine.shape == full.shape
        rms = np.sqrt(np.nanmean((mine - full) ** 2) / np.nanmean(full**2))
        assert rms < 2.0 * TOLERANCE, name
        assert np.array_equal(np.isnan(mine), np.isnan(full))
    for name in ("bearing_loss", "churning_loss"):
        assert getattr(one, name) == pytest.approx(getattr(every, name), rel=TOLERANCE)
    allowed = 2.0 * TOLERANCE * every.energy.driving_work
    # Ledgers end with the last step, which may end a little later in one of the runs.
    longer = every.duration / one.duration
    assert longer == pytest.approx(1.0, abs=1e-3)
    for name in ("friction", "damping", "bearing", "churning", "output"):
        mine, full = getattr(one.energy, name), getattr(every.energy, name)
        assert mine * longer == pytest.approx(full, abs=allowed), name
    for name in ("kinetic", "elastic"):
        mine, full = getattr(one.energy, name), getattr(every.energy, name)
        assert mine == pytest.approx(full, abs=allowed), name
    assert one.energy.stiffness_work == pytest.approx(every.energy.stiffness_work, abs=allowed)
    for energy in (one.energy, every.energy):
        assert abs(energy.residual) < allowed
    assert one.stats.pair_events == every.stats.pair_events


@pytest.mark.parametrize("method", ["auto", "rosenbrock"])
@pytest.mark.parametrize(
    "scene",
    [
        evenly(5),
        evenly(4),
        evenly(5, **LOSSES, **{"mesh.sun_planet_error": {"amplitudes": ["2 um"]}}),
        evenly(5, **fault("planet", planet=2)),
        evenly(5, **{"gearset.held": "ring", "drive.output.member": "carrier"}),
        evenly(4, **{"gearset.held": "sun", "drive.input.member": "carrier"}, input_torque=-250.0),
        evenly(5, **{"mesh.ramp": 0.0, "lubrication.friction_torque": "printed"}),
    ],
    ids=["one", "two", "losses", "fault", "ring", "sun", "printed"],
)
def test_one_planet_of_each_group_gives_the_results_of_all(scene, method):
    options = {"method": method, "tolerance": TOLERANCE}
    one = pt.simulate(scene, 0.01, **options)
    assert_equal_results(one, pt.simulate(scene.replace(**APART), 0.01, **options))
    group = Layout(scene).groups.group
    for i, first in enumerate(group):
        leader = group.index(first)
        assert np.array_equal(one.dte[:, i], one.dte[:, leader])
        assert np.array_equal(one.speed[:, 1 + i], one.speed[:, 1 + leader])


@pytest.mark.parametrize(
    "changes",
    [LOSSES, {"mesh.planet_ring_error": {"amplitudes": ["3 um"]}}, fault("planet", planet=2)],
    ids=["losses", "errors", "fault"],
)
@pytest.mark.parametrize("planets", [4, 5])
def test_one_planet_of_each_group_serves_without_dynamics(planets, changes):
    scene = evenly(planets, dynamics="quasi_static", **changes)
    one = pt.simulate(scene, 0.01, tolerance=TOLERANCE)
    assert_equal_results(one, pt.simulate(scene.replace(**APART), 0.01, tolerance=TOLERANCE))


@pytest.mark.parametrize("planets", [4, 5])
def test_one_planet_of_each_group_rattles_as_all_do(planets):
    """Impacts amplify a difference tenfold, as in the comparison with the reference."""
    ripple = {"torque_ripple": 5.0, "drive.speed_control.ripple_order": 6}
    scene = evenly(planets, input_torque=0.5, **ripple)
    one, every = (
        pt.simulate(s, 0.05, tolerance=TOLERANCE) for s in (scene, scene.replace(**APART))
    )
    assert one.stats.flank_events == every.stats.flank_events > 100
    gap = np.sqrt(np.mean((one.dte - every.dte) ** 2) / np.mean(every.dte**2))
    assert gap < 10.0 * TOLERANCE
    assert one.energy.residual == pytest.approx(0.0, abs=1e-6 * one.energy.driving_work)


def test_windows_show_every_mesh_and_body():
    twin, every = pt.Twin(evenly(5)), pt.Twin(evenly(5, **APART))
    for _ in range(3):
        window, full = twin.advance(0.01), every.advance(0.01)
        assert window.meshes == full.meshes and window.bodies == full.bodies
        assert window.waveform.dte.shape == full.waveform.dte.shape
        for name, values in window.mesh.items():
            assert values == pytest.approx(full.mesh[name], rel=twin.tolerance), name
        assert window.mean_speed == pytest.approx(full.mean_speed, rel=1e-6)
        assert window.power_loss == pytest.approx(full.power_loss, rel=twin.tolerance)
        assert window.machine_torque == pytest.approx(full.machine_torque, rel=1e-4)
