"""Off-the-shelf solvers see the same model, and are held against the same reference."""

import importlib.util
import math

import numpy as np
import pytest
from typer.testing import CliRunner

from planetary_twin_py._records import AXES, new_record
from planetary_twin_py.benchmark.cases import Case
from planetary_twin_py.benchmark.peers.equations import rate
from planetary_twin_py.benchmark.peers.problem import Problem, sample_times
from planetary_twin_py.benchmark.peers.solver import Deadline, TooSlow
from planetary_twin_py.benchmark.peers.solvers import SOLVERS, run
from planetary_twin_py.benchmark.peers.work_precision import peer_rows
from planetary_twin_py.benchmark.reference import Reference
from planetary_twin_py.benchmark.table import SAMPLE_RATE, dte_error
from planetary_twin_py.cli import app
from planetary_twin_py.dynamics.equations import EVALUATION, forces
from planetary_twin_py.dynamics.observe import DTE, QUANTITIES
from planetary_twin_py.engine import Engine
from planetary_twin_py.integrators.march import begin_step
from planetary_twin_py.scene import load_scene

needs_cvode = pytest.mark.skipif(
    importlib.util.find_spec("sksundae") is None, reason="needs the extra [bench]"
)
SMOOTH = Case("smooth", {"lubrication.friction": False}, 0.003, 1)
CASES = [
    {},
    {"input_torque": 0.3, "torque_ripple": 3.0},
    {"mesh.runout.sun": 2e-6, "input_speed": -60.0},
    {"mesh.backlash": "regulatory_factor"},
]


@pytest.mark.parametrize("changes", CASES, ids=str)
def test_the_right_hand_side_is_the_derivative_of_the_twin(changes):
    """At states and times of a run, moved at random within the segments of the step they are in."""
    scene, random = load_scene("paper").replace(**changes), np.random.default_rng(7)
    engine, problem = Engine(scene, 1e-6), Problem(scene)
    model, march, train = engine.model, engine.march, engine.train
    n, axes, work = problem.bodies, problem.axes, new_record(EVALUATION)
    start = problem.record[0]["start"]
    seen = 0
    for until in np.sort(random.uniform(1e-5, 0.02, 40)):
        engine.advance(until, 1, 1.0, 0)
        begin_step(model, march)
        begin = march.begin
        # What the motors have gained on the uniform frame of the peers.
        t, turned = begin.time, begin.turns + begin.fraction
        ahead = 2 * np.pi * turned - start["speed"] * t
        faster = begin.speed - start["speed"]
        x = begin.x + random.normal(0.0, 1e-10, begin.x.size)
        v = begin.v + random.normal(0.0, 1e-5, begin.v.size)
        forces(model, begin, march.moment, x, v, 0.0, begin.trim, work)
        y = np.concatenate([
            x[:n] + (train.ratio[:n] @ ahead) * train.radius[:n] - start["x"][:n],
            v[:n] + (train.ratio[:n] @ faster) * train.radius[:n],
            begin.trim[:axes] - start["trim"][:axes],
        ])  # fmt: skip
        dy = np.empty_like(y)
        rate(problem.record, t, y, dy)
        own = problem.record[0]["state"]
        if not (np.array_equal(own["side"], begin.side)):
            continue
        seen += 1
    assert seen > 20
