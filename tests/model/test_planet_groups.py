"""Planets with the same motion: their groups, and equal results if one of each is integrated."""

import math

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.model.layout import Layout

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
