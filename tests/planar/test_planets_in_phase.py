"""Planets whose forces cancel are integrated once, and repeated cycles are not computed again."""

import numpy as np
import pytest
from planar.moving_scenes import planar
from power_flows import FLOWS, flow_name

import planetary_twin_py as pt
from planetary_twin_py.model.gearbox import Gearbox

IN_PHASE = {
    "gearset.teeth": {"sun": 36, "planet": 18, "ring": 72},
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
