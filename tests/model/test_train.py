"""Bodies and meshes as arrays: no slip in rigid motion, and the natural frequencies."""

import math

import numpy as np
import pytest
from modal.test_torsional import CASES
from power_flows import ALL_FLOWS, DIFFERENTIALS, FLOWS, flow_name, scene_of
from scipy.linalg import eigvalsh

from planetary_twin_py._core import Evaluation, StepConstants, forces, set_step_constants
from planetary_twin_py.model.gearbox import Gearbox
from planetary_twin_py.run.engine import Engine
from planetary_twin_py.scene import load_scene


@ALL_FLOWS
def test_rigid_motion_leaves_every_mesh_as_it_is(flow):
    train = Gearbox(scene_of(flow)).train
    travel = train.body.ratio * train.body.radius[:, None]
    meshes = int(train.meshes)
    motion = (train.mesh.sign[:meshes, :, None] * travel[train.mesh.body[:meshes]]).sum(axis=1)
    assert motion == pytest.approx(0.0, abs=1e-15)


@pytest.mark.parametrize("name", ["paper", "differential", "floating_sun"])
def test_a_train_does_not_depend_on_the_operating_point(name):
    scene = load_scene(name)
    point = {"lambda_ratio": 1.7, "input_torque": 9.0, "backlash": 3e-6, "oil_temperature": 300.0}
    trains = [Gearbox(each).train for each in (scene, scene.replace(**point))]
    assert trains[0].raw().tobytes() == trains[1].raw().tobytes()


def stiffness_matrix(model, state, bodies):
    """-dF/dx of the compiled equations, by differences of what is linear."""
    out, moment = Evaluation(), StepConstants()
    set_step_constants(model, state, moment)
    columns = []
    for j in range(bodies):
        ends = []
        for x in (-1e-6, 1e-6):
            place = np.zeros_like(state.x)
            place[j] = x
            forces(model, state, moment, place, np.zeros_like(place), 0.0, np.zeros(2), out)
            ends.append(np.array(out.force[:bodies]))
        columns.append((ends[0] - ends[1]) / 2e-6)
    return np.array(columns).T


APART = {"mesh.runout.sun": 1e-16}  # too small for any result, but every planet moves differently


def natural_frequencies(flow, **changes):
    """Of gears and carrier alone [Hz], machines off, one constant stiffness in all meshes."""
    scene = scene_of(
        flow, **{"mesh.double_pair_ratio": 1.0, "lubrication.friction": False, **changes}
    )
    engine = Engine(scene, 1e-4)
    model = engine.model
    model.train.coupling.stiffness[:] = 0.0
    bare = int(model.train.bodies - model.train.machines)
    stiffness = stiffness_matrix(model, engine.integrator.begin, bare)
    assert stiffness == pytest.approx(stiffness.T, abs=1e-6 * stiffness.max())
    squares = eigvalsh(stiffness, np.diag(model.train.body.mass[:bare]))
    return np.sqrt(np.maximum(squares, 0.0)) / (2 * math.pi)


@pytest.mark.parametrize(
    "flow, expected", CASES, ids=lambda v: flow_name(v) if isinstance(v, tuple) else ""
)
def test_natural_frequencies_of_the_bare_gearset(flow, expected):
    found = natural_frequencies(flow)
    rigid = expected.count(0)
    assert found[:rigid] == pytest.approx(0.0, abs=0.5)
    assert found[rigid:] == pytest.approx(expected[rigid:], abs=0.01)


@pytest.mark.parametrize("flow", [FLOWS[0], FLOWS[3], DIFFERENTIALS[0]], ids=str)
@pytest.mark.parametrize("planets, groups", [(2, 1), (4, 2), (5, 1)])
def test_planet_modes_depend_only_on_planet_and_meshes(flow, planets, groups):
    """With planets in phase, the train has all modes but those of planets against one another."""
    changes = {
        "gearset.planet_angles": tuple(2 * math.pi * k / planets for k in range(planets)),
        "mesh.planet_ring_stiffness": 3e8,
    }
    grouped, every = (
        natural_frequencies(flow, **changes),
        natural_frequencies(flow, **changes, **APART),
    )
    mass = 0.1 / math.cos(math.radians(21.34)) ** 2
    mode = math.sqrt((2e8 + 3e8) / mass) / (2 * math.pi)
    assert np.isclose(every, mode, rtol=1e-7).sum() == planets - 1
    kept = np.sort([*grouped, *[mode] * (planets - groups)])
    assert kept == pytest.approx(every, rel=1e-7, abs=0.5)
