"""The stable step of twins in series, by coupled twins below and above it."""

import math

import numpy as np
import pytest
from ports.ports_of_paper import at_rest

import planetary_twin_py as pt

FLANGE = 2e-5  # [kg m^2], light: it vibrates between both shafts while the gears stay at rest


def joint(before, behind, damping=0.0, **changes):
    """Scenes of two gearboxes that a light flange joins, and their limit [s]."""
    first = at_rest(
        "motion",
        "torque",
        **{
            "drive.output.inertia": FLANGE,
            "drive.output.coupling_stiffness": before,
            "drive.output.coupling_damping": damping,
        },
        **changes,
    )
    second = at_rest(
        "motion",
        "motion",
        **{"drive.input.coupling_stiffness": behind, "drive.input.coupling_damping": damping},
        **changes,
    )
    return first, second


def swing(scenes, step, count=400):
    """Peak speeds of the flange in the first and the last quarter, after a kick of torque."""
    first, second = (pt.Twin(scene, tolerance=1e-5) for scene in scenes)
    speeds, back = [], 0.0
    for n in range(count):
        try:
            front = first.step(
                step, input_speed=0.0, output_torque=back + (1e-3 if n == 0 else 0.0)
            )
            behind = second.step(step, input_speed=front.output_speed, output_speed=0.0)
        except (ValueError, pt.RunawayError):  # beyond the limits of the drive
            return max(np.abs(speeds[: count // 4])), math.inf
        speeds.append(front.output_speed)
        back = -behind.input_torque
    quarter = count // 4
    return np.abs(speeds[:quarter]).max(), np.abs(speeds[-quarter:]).max()


@pytest.mark.parametrize(("before", "behind"), [(3000.0, 3000.0), (3000.0, 500.0), (30.0, 3000.0)])
def test_vibration_grows_above_the_limit_and_not_below(before, behind):
    scenes = joint(before, behind)
    limit = pt.check_exchange(*scenes, 1e-6)
    early, late = swing(scenes, 0.93 * limit)
    assert late < 3.0 * early
    early, late = swing(scenes, 1.1 * limit)
    assert late > 100.0 * early


def test_flange_on_soft_shaft_has_the_limit_of_symplectic_euler():
    limit = pt.check_exchange(*joint(1e-3, 3000.0), 1e-6)
    assert limit == pytest.approx(2.0 * math.sqrt(FLANGE / 3000.0), rel=1e-6)


def test_linear_exchange_is_stable_below_the_decay_of_shafts():
    scenes = joint(3000.0, 3000.0, damping=0.01, **{"drive.interpolation": "linear"})
    limit = pt.check_exchange(*scenes, 1e-6)
    assert limit == pytest.approx(2.0 * 0.01 / 3000.0)
    early, late = swing(scenes, 0.7 * limit, 2000)
    assert late < early
    early, late = swing(scenes, 1.4 * limit, 2000)
    assert late > 2.0 * early


@pytest.mark.parametrize("step", [2e-4, 0.0, math.nan])
def test_a_step_beyond_the_limit_is_refused_with_it(step):
    with pytest.raises(ValueError, match=r"step = .* s: must be above 0 and at most 0\.000138 s"):
        pt.check_exchange(*joint(3000.0, 3000.0), step)


def test_ports_that_do_not_exchange_speed_and_torque_are_refused():
    first, second = joint(3000.0, 3000.0)
    with pytest.raises(ValueError, match=r"drive\.output\.port = 'motion'.* one of the two must"):
        pt.check_exchange(first.replace(**{"drive.output.port": "motion"}), second, 1e-5)
