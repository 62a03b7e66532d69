"""Off-the-shelf solvers see the same model, and are held against the same reference."""

import ctypes
import sys
from importlib.util import find_spec

import numpy as np
import pytest
from command_line import invoke
from planetary_twin_benchmark.cases import Case
from planetary_twin_benchmark.peers import cvode, cvode_compiled, cyrk, sundials
from planetary_twin_benchmark.peers.problem import Problem
from planetary_twin_benchmark.peers.solver import SolverError
from planetary_twin_benchmark.peers.solvers import SOLVERS, run
from planetary_twin_benchmark.reference import Reference
from planetary_twin_benchmark.table import dte_error
from planetary_twin_benchmark.timing import SAMPLE_RATE
from planetary_twin_core_parts import derivative

from planetary_twin_py._core import DTE, Evaluation, begin_step, forces
from planetary_twin_py.run.engine import Engine
from planetary_twin_py.scene import load_scene, packaged_scenes

pytestmark = pytest.mark.slow

SMOOTH = Case("smooth", {"lubrication.friction": False}, 0.002, 1)
SHORT = Case("short", {}, 0.002, 1)
VISCOUS = Case("viscous", {"mesh.damping.law": "viscous"}, 0.002, 1)
MISSING = [
    *([] if find_spec("sksundae") else [*cvode.SOLVERS, *cvode_compiled.SOLVERS]),
    *([] if find_spec("CyRK") else cyrk.SOLVERS),
]
INSTALLED = [name for name in SOLVERS if name not in MISSING]
SLOW = ("scipy_lsoda", "lsoda_compiled", "cvode_bdf_compiled")  # of similar solvers
SCENES = {
    "rattle": ("paper", {"input_torque": 0.3, "torque_ripple": 3.0}),
    "backwards with runout": (
        "paper",
        {"input_speed": -60.0, "mesh.runout.sun": 2e-6, "backlash": 2e-6},
    ),
    "regulatory factor": ("paper", {"mesh.backlash": "regulatory_factor", "input_torque": -20.0}),
    **{name: (name, {}) for name in packaged_scenes() if not load_scene(name).moving_axes},
}


@pytest.fixture(scope="module")
def references():
    return {
        case.name: Reference(case.scene()).run(case.duration, SAMPLE_RATE)
        for case in (SMOOTH, SHORT, VISCOUS)
    }


@pytest.mark.parametrize(
    ("base", "changes"),
    [
        pytest.param(*scene, id=name, marks=() if name == "rattle" else pytest.mark.exhaustive)
        for name, scene in SCENES.items()
    ],
)
def test_the_right_hand_side_is_the_derivative_of_the_twin(base, changes):
    """At random states within the segments that steps of the integrator begin in."""
    scene, random = load_scene(base).replace(**changes), np.random.default_rng(7)
    engine, problem, out = Engine(scene, 1e-5), Problem(scene), Evaluation()
    train, integrator, n = engine.train, engine.integrator, problem.bodies
    start, own = problem.record.start, problem.record.state
    motors, meshes = train.coupling.ends[: 2 * problem.axes : 2, 0], problem.meshes
    rigid, radius = train.body.ratio[:n], train.body.radius[:n]
    compared = 0
    for until in np.sort(random.uniform(1e-4, 0.02, 60)):
        engine.sample(until)
        integrator.control.changed = True
        begin_step(engine.model, integrator)
        begin = integrator.begin
        x, v = np.array(begin.x), np.array(begin.v)
        x[:n] += random.normal(0.0, 1e-9, n)
        v[:n] += random.normal(0.0, 1e-4, n)
        x[motors] = v[motors] = 0.0  # they are the frame, and their speed the damping's
        forces(engine.model, begin, integrator.constants, x, v, 0.0, begin.trim, out)

        ahead = 2.0 * np.pi * (begin.turns + begin.fraction) - start.speed * begin.time
        faster = begin.speed - start.speed
        y = np.concatenate([
            x[:n] + rigid @ ahead * radius - start.x[:n],
            v[:n] + rigid @ faster * radius,
            (begin.trim - start.trim)[: problem.axes],
        ])  # fmt: skip
        dy = np.empty_like(y)
        derivative(problem.record, begin.time, y, dy)
        closed = begin.side[:meshes] != 0
        if not np.array_equal(own.side, begin.side) or not np.array_equal(
            own.segment[:meshes][closed], begin.segment[:meshes][closed]
        ):
            continue  # the integrator begins many steps at an edge
        compared += 1
        acceleration = out.force[:n] / train.body.mass[:n]
        lag = begin.set_speed - begin.speed
        np.testing.assert_array_equal(dy[:n], y[n : 2 * n])
        np.testing.assert_allclose(
            dy[n : 2 * n], acceleration, rtol=1e-8, atol=1e-8 * abs(acceleration).max()
        )
        np.testing.assert_allclose(dy[2 * n :], lag[: problem.axes], atol=1e-10)
    assert compared >= 20


@pytest.mark.exhaustive
@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=pytest.mark.exhaustive if name in SLOW else ())
        for name in INSTALLED
    ],
)
def test_the_error_falls_with_the_tolerance(name, references):
    errors = [
        dte_error(solved(name, SHORT, tolerance).dte, references["short"][:, DTE])
        for tolerance in (3e-3, 3e-4)
    ]
    assert 3 * errors[1] < errors[0] < 5e-2


@pytest.mark.exhaustive
@pytest.mark.parametrize(
    # Damping that follows the speed does so at once here, in the reference event by event.
    ("case", "agreement"),
    [(SMOOTH, 1e-6), (VISCOUS, 1e-8)],
    ids=["smooth", "viscous"],
)
def test_a_tight_tolerance_converges_to_the_reference(case, agreement, references):
    found = solved("scipy_dop853", case, 1e-11).dte
    assert dte_error(found, references[case.name][:, DTE]) < agreement


@pytest.mark.skipif("cvode_bdf" in MISSING, reason="needs the extra [bench]")
def test_cvode_is_given_the_same_right_hand_side_compiled():
    problem, random = Problem(SHORT.scene()), np.random.default_rng(3)
    own = cvode_compiled.callback(problem)
    setting = sundials.Setting(sundials.BDF, own.function, own.data, 1e-4, 1e-4 * problem.scale, 1)
    pointers = [ctypes.c_void_p] * 3
    called = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_double, *pointers)(own.function)
    with sundials.cvode(setting) as given, sundials.cvode(setting) as answer:
        for time in random.uniform(0.0, problem.mesh_period, 20):
            given.y[:] = random.normal(0.0, 0.01, problem.size) * problem.scale
            dy = np.empty(problem.size)
            derivative(problem.record, time, given.y.copy(), dy)
            assert called(time, given.vector, answer.vector, own.data) == 0
            np.testing.assert_allclose(answer.y, dy, rtol=1e-9, atol=1e-12 * abs(dy).max())


def test_a_step_beyond_the_limit_of_stability_is_reported():
    with pytest.raises(SolverError, match="unstable"):
        run("semi_implicit_euler", SHORT.scene(), 0.02, SAMPLE_RATE, 1e-2, 60.0)


@pytest.mark.parametrize("package", ["sksundae", "CyRK"])
def test_a_missing_package_of_peers_ends_in_one_line(monkeypatch, package):
    monkeypatch.setitem(sys.modules, package, None)
    answer = invoke("bench", "--peers")
    assert answer.exit_code == 2
    assert answer.output.splitlines() == [
        "planetary-twin: required packages are missing: pip install 'planetary_twin_py[bench]'"
    ]


def solved(name, case, tolerance):
    return run(name, case.scene(), case.duration, SAMPLE_RATE, tolerance, 60.0)
