"""Order of the rosenbrock_step on a smooth stretch: no event, no friction, equal steps."""

import numpy as np
import pytest
from planetary_twin_core_parts import rosenbrock_step
from power_flows import FLOWS, scene_of

from planetary_twin_py._core import Workspace, begin_step, forces
from planetary_twin_py.run.engine import Engine
from planetary_twin_py.scene import load_scene

SPAN = 4e-5  # [s] within one segment of all meshes


def integrator(steps):
    """Bodies displaced from balance, after SPAN in equal steps."""
    scene = scene_of(FLOWS[0], **{"lubrication.friction": False, "mesh.damping.law": "viscous"})
    engine = Engine(scene, 1e-4)
    model, run = engine.model, engine.integrator
    run.end.x[:5] += np.array([3.0, -2.0, 1.0, 2.0, -1.0]) * 1e-6
    work, h = Workspace(), SPAN / steps
    run.control.changed = True
    begin_step(model, run)
    state, new, moment = run.begin.copy(), run.begin.copy(), run.constants
    start = moment.start.copy()
    for i in range(steps):
        moment.start[:] = start + moment.cycle_rate * i * h
        forces(model, state, moment, state.x, state.v, 0.0, state.trim, run.first)
        rosenbrock_step(model, state, moment, h, run.first, new, work)
        state = new.copy()
        state.fraction[:] = run.begin.fraction + run.begin.speed * h * (i + 1) / (2 * np.pi)
    return np.concatenate([state.x, state.v / 1e4])


@pytest.mark.exhaustive
def test_global_error_falls_with_the_third_power_of_the_step():
    exact = integrator(4096)
    counts = np.array([16, 24, 32, 48, 64])
    errors = [np.abs(integrator(count) - exact).max() for count in counts]
    order = np.polyfit(np.log(SPAN / counts), np.log(errors), 1)[0]
    assert order == pytest.approx(3.0, abs=0.2)


def test_a_state_that_is_not_finite_ends_the_run():
    engine = Engine(load_scene("paper"), 1e-3)
    engine.integrator.end.x[0] = np.nan
    with pytest.raises(ArithmeticError, match="no finite state"):
        engine.sample(0.01)
