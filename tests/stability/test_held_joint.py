"""A loaded joint that friction holds comes to rest, and steps are as long as without load."""

from pathlib import Path

import pytest

import planetary_twin_py as pt

EXAMPLE = Path(__file__).parents[2] / "docs/examples/geared_joint.yaml"
STEP = 1e-3  # [s] of the caller


@pytest.mark.parametrize("tolerance", [1e-2, 3e-3, 1e-3])
@pytest.mark.parametrize(("input_torque", "output_torque"), [(0.5, -2.95), (0.2, -1.195)])
def test_it_needs_few_steps(input_torque, output_torque, tolerance):
    twin = pt.Twin(pt.load_scene(EXAMPLE), tolerance=tolerance)
    control = twin._engine.control

    def steps(calls):
        before = control.steps
        for _ in range(calls):
            twin.step(STEP, input_torque=input_torque, output_torque=output_torque)
        return control.steps - before

    steps(500)
    assert steps(500) < 2 * 500
    assert abs(twin.step(STEP).input_speed) < 1e-3
