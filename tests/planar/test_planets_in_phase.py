"""Planets whose forces cancel are integrated once, and repeated cycles are not computed again."""

import numpy as np
import pytest
from planar.moving_scenes import planar
from power_flows import FLOWS, flow_name

import planetary_twin_py as pt
from planetary_twin_py.model.cycle import common_cycles
from planetary_twin_py.model.gearbox import Gearbox
from planetary_twin_py.run.engine import Engine

IN_PHASE = {
    "gearset.teeth": {"sun": 36, "planet": 18, "ring": 72},
    "gearset.planet_angles": tuple(np.arange(4) * np.pi / 2.0),
}
OPPOSITE_IN_PHASE = {
    "gearset.teeth": {"sun": 30, "planet": 20, "ring": 70},
    "gearset.planet_angles": tuple(np.arange(4) * np.pi / 2.0),
}
APART = {"errors.planet_thickness": (0.0, 0.0, 0.0, 1e-18)}  # [m], below every rounding error


@pytest.mark.parametrize("flow", FLOWS[:4], ids=flow_name)
def test_they_move_as_if_each_were_integrated(flow):
    scene = planar(flow, **IN_PHASE)
    together, apart = (
        pt.simulate(one, 0.01, 20_000.0, tolerance=1e-7, method="march")
        for one in (scene, scene.replace(**APART))
    )
    assert np.abs(apart.axes.displacement[:, :3]).max() < 1e-9  # sun, ring, carrier
    assert together.dte == pytest.approx(apart.dte, abs=1e-6 * np.abs(apart.dte).max())
    for name in ("displacement", "bearing_force", "orbit", "flank_force"):
        found, expected = getattr(together.axes, name), getattr(apart.axes, name)
        size = np.abs(apart.axes.displacement if name == "orbit" else expected).max()
        assert found == pytest.approx(expected, abs=3e-6 * size), name
    assert together.axes.mean_load_share == pytest.approx([1.0] * 4, abs=1e-9)
    loss = [run.mesh["power_loss"].sum() for run in (together, apart)]
    assert loss[0] == pytest.approx(loss[1], rel=1e-6)


def test_opposite_planets_in_phase_are_integrated_in_pairs():
    scene = planar(**OPPOSITE_IN_PHASE)
    assert Gearbox(scene).groups.group == (0, 1, 0, 1)
    together, apart = (
        pt.simulate(one, 0.005, 20_000.0, tolerance=1e-7, method="march")
        for one in (scene, scene.replace(**APART))
    )
    assert together.dte == pytest.approx(apart.dte, abs=1e-6 * np.abs(apart.dte).max())


@pytest.mark.parametrize(
    "change",
    [
        APART,
        {"errors.ring_offset": {"size": 1e-6, "angle": 0.0}},
        {"mesh.runout.sun": 1e-6},
        {"faults": ({"kind": "crack", "gear": "sun", "tooth": 0, "stiffness_loss": 0.1},)},
    ],
    ids=["tooth thickness", "ring offset", "runout", "crack"],
)
def test_whatever_moves_an_axis_keeps_planets_apart(change):
    scene = planar(**IN_PHASE)
    assert Gearbox(scene).groups.sizes == (4,)
    assert Gearbox(scene.replace(**change)).groups.sizes == (1, 1, 1, 1)
    assert Gearbox(scene).train.bodies < Gearbox(scene.replace(**change)).train.bodies


def test_planets_out_of_phase_move_the_axes_and_stay_apart():
    scene = planar()
    assert Gearbox(scene).groups.sizes == (1, 1, 1)


@pytest.mark.exhaustive
@pytest.mark.parametrize("flow", [FLOWS[0], FLOWS[2]], ids=["held carrier", "turning carrier"])
def test_repeated_cycles_show_the_axes_as_if_they_were_computed(flow):
    scene = planar(flow, {"sun": 0.0}, **{"errors.pin_tangential": (-1e-5, 0.0, 0.0)})
    repeated, computed = (
        pt.simulate(scene, 0.01, 20_000.0, settling=3.0, tolerance=1e-4, method=method)
        for method in ("auto", "march")
    )
    assert repeated.stats.repeated_steps > 0.3 * computed.stats.steps
    swing = np.ptp(computed.axes.displacement, axis=0).max()
    assert np.abs(repeated.axes.displacement - computed.axes.displacement).max() < 3e-3 * swing
    force = np.abs(computed.axes.bearing_force).max()
    assert np.abs(repeated.axes.bearing_force - computed.axes.bearing_force).max() < 1e-3 * force
    assert repeated.mesh["dte_rms"] == pytest.approx(computed.mesh["dte_rms"], rel=3e-4)


def test_weight_repeats_with_the_turns_of_the_carrier():
    turning = planar(FLOWS[2], **{"supports.gravity": 9.81})
    held = planar(FLOWS[0], **{"supports.gravity": 9.81})
    cycles = [
        common_cycles(Gearbox(scene).train, Engine(scene, 1e-3).model.operation)
        for scene in (held, turning)
    ]
    assert cycles == [1, 70]  # mesh cycles in a turn of the carrier against the held ring
