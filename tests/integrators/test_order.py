"""Order of collocation by regression on a smooth stretch: no event, equal steps, friction on."""

import numpy as np
import pytest
from planetary_twin_core_parts import (
    NO_MESH,
    accept,
    end_within,
    enter,
    set_step,
    sweep,
    update_nodes,
)

from planetary_twin_py._core import begin_step, radau
from planetary_twin_py.run.engine import Engine
from planetary_twin_py.scene import load_scene

START, SPAN = 1e-5, 6e-5  # [s] within one segment of all meshes
TIGHT = 1e-6  # steps are given; from 1e-5 on friction has single precision, which hides the order
SWEEPS = 12  # they rest to the last digit
DISPLACED = np.array([3.0, -2.0, 1.0, 2.0, -1.0]) * 1e-7  # [m] from balance
# Friction that does not turn round within a step at the pitch point, but is as strong.
SMOOTH = {"mesh.damping.law": "viscous", "lubrication.sliding_threshold": 1.0}


def integrator(points, steps):
    """Displaced bodies after SPAN in equal steps with so many nodes, and the events on the way."""
    scene = load_scene("paper").replace(**SMOOTH)
    engine = Engine(scene, TIGHT)
    engine.sample(START)
    engine.change(scene.operating_point, TIGHT, START)
    model, run = engine.model, engine.integrator
    run.run.nodes = radau(points)
    run.end.x[: len(DISPLACED)] += DISPLACED
    count = run.control
    before = int(count.pair_events + count.flank_events)
    for _ in range(steps):
        begin_step(model, run)
        enter(model, run)
        set_step(model, run, SPAN / steps)
        update_nodes(model, run)
        for _ in range(SWEEPS):
            sweep(model, run, True)
            update_nodes(model, run)
        end_within(model, run, SPAN / steps)
        accept(model, run, NO_MESH)
    begin_step(model, run)  # in the frame of the motor
    events = int(count.pair_events + count.flank_events) - before
    return np.concatenate([run.begin.x, run.begin.v / 1e4]), events


@pytest.fixture(scope="module")
def exact():
    end, events = integrator(5, 32)
    assert events == 0
    return end


@pytest.mark.exhaustive
@pytest.mark.parametrize(("points", "counts"), [(3, [4, 6, 8, 12]), (4, [3, 4, 6, 8])])
def test_global_error_falls_with_the_order_of_the_quadrature(points, counts, exact):
    """Radau's points are exact for powers up to 2 s - 2, and collocation inherits their order."""
    errors = [np.abs(integrator(points, count)[0] - exact).max() for count in counts]
    order = np.polyfit(np.log(SPAN / np.array(counts)), np.log(errors), 1)[0]
    assert order == pytest.approx(2 * points - 1, abs=0.5)
