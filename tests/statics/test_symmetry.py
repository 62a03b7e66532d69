"""A mirrored, turned or renumbered gear set runs as the set itself."""

import math

import numpy as np
import pytest
from planar.moving_scenes import planar
from power_flows import FLOWS, flow_name

from planetary_twin_py import simulate
from planetary_twin_py.statics.load_sharing import load_sharing

ERRORS = {
    "errors.pin_tangential": [-2e-5, 5e-6, 0.0],
    "errors.pin_radial": [0.0, 1e-5, -5e-6],
    "errors.planet_thickness": [0.0, 3e-6, 0.0],
}
WEIGHT = {"supports.gravity": 50.0, "supports.gravity_direction": -1.1}
SETS = [(FLOWS[0], WEIGHT), (FLOWS[2], {}), (FLOWS[4], {})]
EACH_SET = pytest.mark.parametrize(
    ("flow", "weight"), SETS, ids=[flow_name(flow) for flow, _ in SETS]
)
SETTLED = 1.0  # [s], as the speed loop is slow
STEP = 2.0 * math.pi / 100.0
FLIP = np.array([1.0, -1.0])


def uneven(flow, weight):
    """A set whose planets are neither equal nor evenly spaced."""
    angles = [0.0, 33.0 * STEP, 67.0 * STEP]
    return planar(flow, {"sun": 1e7}, **ERRORS, **{"gearset.planet_angles": angles}, **weight)


def mirrored(scene):
    """The set in a mirror along x: what counts counter-clockwise changes its sign."""
    point = scene.operating_point
    return scene.replace(
        **{
            "gearset.planet_angles": [-angle for angle in scene.gearset.planet_angles],
            "errors.pin_tangential": [-error for error in scene.errors.pin_tangential],
            "supports.gravity_direction": -scene.supports.gravity_direction,
            "input_torque": -point.input_torque,
            "input_speed": -point.input_speed,
        }
    )


@EACH_SET
def test_a_mirrored_set_shares_its_static_load_in_the_mirror(flow, weight):
    scene = uneven(flow, weight)
    one, other = (load_sharing(each) for each in (scene, mirrored(scene)))
    # Teeth of the mirrored set start elsewhere in the mesh cycle: compare means.
    assert other.share.mean(axis=0) == pytest.approx(one.share.mean(axis=0), rel=1e-4)
    swapped = one.mesh_force.mean(axis=0)[::-1]
    assert other.mesh_force.mean(axis=0) == pytest.approx(swapped, rel=1e-4, abs=0.1)
    for name in ("bearing", "planet_bearing", "displacement"):
        straight, seen = (getattr(each, name).mean(axis=0) for each in (one, other))
        assert seen == pytest.approx(straight * FLIP, abs=1e-4 * np.abs(straight).max())


def test_turning_set_and_weight_turns_displacements_alone():
    angle = 0.7
    scene = uneven(*SETS[0])
    turned = scene.replace(
        **{
            "gearset.planet_angles": [a + angle for a in scene.gearset.planet_angles],
            "supports.gravity_direction": scene.supports.gravity_direction + angle,
        }
    )
    one, other = (simulate(each, 0.01, tolerance=1e-6) for each in (scene, turned))
    assert other.mesh_force == pytest.approx(one.mesh_force, rel=1e-6)
    rotation = np.exp(1j * angle)
    straight, seen = (run.axes.displacement @ np.array([1.0, 1.0j]) for run in (one, other))
    scale = np.abs(straight).max()
    assert np.abs(seen[:, :3] - rotation * straight[:, :3]).max() < 1e-6 * scale
    assert np.abs(seen[:, 3:] - straight[:, 3:]).max() < 1e-6 * scale
