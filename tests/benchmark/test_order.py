"""Orders of the baselines with a fixed step, by regression on a smooth case against DOP853."""

import numpy as np
import pytest
from planetary_twin_benchmark.peers.problem import Problem
from planetary_twin_benchmark.reference import Reference
from planetary_twin_core_parts import runge_kutta_4, semi_implicit_euler

from planetary_twin_py._core import DTE
from planetary_twin_py.scene import load_scene

DURATION = 5e-4  # [s] a quarter of a mesh period
# Nothing in it jumps: constant stiffness, no friction, teeth excited by their errors of form.
SMOOTH = {
    "lubrication.friction": False,
    "mesh.double_pair_ratio": 1.0,
    "mesh.damping.law": "viscous",
    "mesh.sun_planet_error": {"amplitudes": [1e-6]},
    "mesh.planet_ring_error": {"amplitudes": [1e-6]},
}


@pytest.fixture(scope="module")
def scene():
    return load_scene("paper").replace(**SMOOTH)


@pytest.fixture(scope="module")
def exact(scene):
    return Reference(scene).run(DURATION, 1.0 / DURATION)[:, DTE]


@pytest.mark.exhaustive
@pytest.mark.parametrize(
    ("method", "order", "counts"),
    [(runge_kutta_4, 4, [32, 48, 64, 96, 128]), (semi_implicit_euler, 1, [256, 384, 512, 768])],
    ids=["rk4", "semi_implicit_euler"],
)
def test_the_error_falls_with_the_order_of_the_step(method, order, counts, scene, exact):
    errors = []
    for count in counts:
        problem = Problem(scene)
        y, samples = np.zeros(problem.size), np.zeros((1, problem.size))
        method(problem.record, np.array([0.0, DURATION]), count, y, samples)
        found, _ = problem.observe(np.array([DURATION]), samples)
        errors.append(np.abs(found - exact).max())
    slope = np.polyfit(np.log(DURATION / np.array(counts)), np.log(errors), 1)[0]
    assert slope == pytest.approx(order, abs=0.2)
