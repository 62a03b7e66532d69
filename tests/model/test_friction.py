"""Tooth friction as a generalised force: its power on any motion is that of the sliding."""

import inspect

import numpy as np
import pytest
from lubrication.friction_laws import EXAMPLE_TABLE, FRICTION_LAWS
from planetary_twin_core_parts import OPEN, copy_segment, find_segment, mesh_motion
from power_flows import ALL_FLOWS, FLOWS, scene_of

from planetary_twin_py._core import (
    COAST_SIDE,
    DRIVE_SIDE,
    FRICTION,
    Evaluation,
    StepConstants,
    forces,
    set_step_constants,
)
from planetary_twin_py.run.engine import Engine


def random_moment(engine, random):
    """Bodies anywhere, moving at random, meshes on the side this takes them to."""
    train, state, moment = engine.train, engine.integrator.begin, StepConstants()
    bodies = int(train.bodies)
    x, v = np.zeros_like(state.x), np.zeros_like(state.v)
    x[:bodies] = random.normal(0.0, 1e-5, bodies)
    state.x = x
    v[:bodies] = random.normal(0.0, 0.3, bodies)
    set_step_constants(engine.model, state, moment)
    for i in range(train.meshes):
        state.side[i] = DRIVE_SIDE if mesh_motion(train, i, x) > 0.0 else COAST_SIDE
        moment.start[i] = random.uniform()
        state.segment[i] = find_segment(train, train.mesh.kind[i], moment.start[i], 1.0)
        copy_segment(train, state, moment, i)
    return state, moment, x, v


def sliding_speeds(train, pairs, speed):
    """rho1 (w1 - wc) + rho2 (w2 - wc) at an external mesh, rho1 (w1 - wc) - rho2 (w2 - wc) at an
    internal one, at angular speeds of bodies and ground."""
    result = []
    for p in range(pairs.count):
        mesh = p % train.meshes
        first, second, carrier = (speed[j] for j in train.mesh.body[mesh])
        sense = 1.0 if train.mesh.kind[mesh] == 0 else -1.0
        result.append(
            pairs.rho1[p] * (first - carrier) + sense * pairs.rho2[p] * (second - carrier)
        )
    return np.array(result)


@ALL_FLOWS
@pytest.mark.parametrize("seed", range(3))
def test_power_of_friction_is_force_times_sliding_speed(flow, seed):
    random = np.random.default_rng(seed)
    engine = Engine(scene_of(flow), 1e-4)
    train = engine.train
    state, moment, x, v = random_moment(engine, random)
    with_friction, without = Evaluation(), Evaluation()
    forces(engine.model, state, moment, x, v, 0.0, np.zeros(2), with_friction)
    engine.model.train.friction = False
    forces(engine.model, state, moment, x, v, 0.0, np.zeros(2), without)

    pairs, bodies = with_friction.pairs, int(train.bodies)
    friction = pairs.friction[: pairs.count]
    assert (pairs.load[: pairs.count] > 0.0).sum() >= 3 and np.abs(friction).max() > 1.0
    q = (with_friction.force - without.force)[:bodies]
    speed = train.body.ratio @ state.speed + v / train.body.radius.clip(1e-9)
    sliding = sliding_speeds(train, pairs, speed)
    assert pairs.sliding[: pairs.count] == pytest.approx(sliding, rel=1e-9)
    assert (friction * sliding).min() >= 0.0
    loss = friction @ sliding
    assert with_friction.power[FRICTION] == pytest.approx(loss, rel=1e-12)
    assert q @ (train.body.radius * speed)[:bodies] == pytest.approx(-loss, rel=1e-9)

    virtual = np.append(random.normal(size=bodies), 0.0)
    power = q @ (train.body.radius[:bodies] * virtual[:bodies])
    expected = -friction @ sliding_speeds(train, pairs, virtual)
    assert power == pytest.approx(expected, rel=1e-9, abs=1e-12 * np.abs(friction).sum())


@ALL_FLOWS
def test_turning_everything_together_meets_no_friction(flow):
    engine = Engine(scene_of(flow), 1e-4)
    out, bodies = Evaluation(), int(engine.train.bodies)
    forces(engine.model, *random_moment(engine, np.random.default_rng(1)), 0.0, np.zeros(2), out)
    torque = (out.friction_force * engine.train.body.radius)[
        : bodies + 1
    ]  # the last is that on the ground
    assert np.abs(torque).max() > 0.0
    assert torque.sum() == pytest.approx(0.0, abs=1e-12 * np.abs(torque).sum())


@ALL_FLOWS
def test_pairs_of_a_mesh_share_all_of_its_force(flow):
    engine = Engine(scene_of(flow), 1e-4)
    out = Evaluation()
    forces(engine.model, *random_moment(engine, np.random.default_rng(2)), 0.0, np.zeros(2), out)
    meshes, slots = int(engine.train.meshes), int(engine.train.teeth.slots)
    assert out.pairs.count == slots * meshes
    shares = out.pairs.share[: slots * meshes].reshape(slots, meshes).sum(axis=0)
    assert shares == pytest.approx(1.0)


LAWS = {
    law: {"lubrication.traction": law, "lubrication.friction_table": EXAMPLE_TABLE}
    for law in FRICTION_LAWS
} | {
    "prescribed": {},
    "computed": {"lubrication.lambda_ratio": "computed"},
    "as printed": {"lubrication.asperities": "printed", "lubrication.traction": "printed"},
    "sharing": {"lubrication.boundary": "load_sharing", "lubrication.lambda_ratio": "computed"},
    "default": {
        "lubrication.boundary": "load_sharing",
        "lubrication.lambda_ratio": "computed",
        "lubrication.traction": "eyring",
    },
    "rolling": {"lubrication.rolling": "goksem_hargreaves"},
    "torque": {"lubrication.friction_torque": "printed"},
    "worn": {"faults": [{"kind": "wear", "gear": "sun", "tooth": 1, "depth": "2 um"}]},
    "free of load": {"backlash": 1e-3},
}


def vars_of(record):
    members = inspect.getmembers(type(record), lambda member: isinstance(member, property))
    return {name: getattr(record, name) for name, _ in members}


@pytest.mark.parametrize("laws", LAWS.values(), ids=LAWS)
def test_open_meshes_and_absent_pairs_rub_on_nothing(laws):
    """They stand in the same registers as those that do."""
    random = np.random.default_rng(3)
    engine = Engine(scene_of(FLOWS[0], **laws), 1e-4)
    train, out = engine.train, Evaluation()
    meshes, slots = int(train.meshes), int(train.teeth.slots)
    seen = np.zeros(2, dtype=int)
    for _ in range(20):
        state, moment, x, v = random_moment(engine, random)
        for i in random.choice(meshes, 2, replace=False):
            state.side[i] = OPEN
            copy_segment(train, state, moment, i)
        forces(engine.model, state, moment, x, v, 0.0, np.zeros(2), out)
        columns = {
            name: values[: slots * meshes].reshape(slots, meshes).copy()
            for name, values in vars_of(out.pairs).items()
            if isinstance(values, np.ndarray)
        }
        is_open = state.side[:meshes] == OPEN
        present = train.teeth.present[train.mesh.kind[:meshes], state.segment[:meshes]]
        idle = is_open | (np.arange(slots)[:, None] >= present)
        seen += is_open.sum(), (idle & ~is_open).sum()
        for name, values in columns.items():
            assert np.isfinite(values).all(), name
        for name in (
            "load", "friction", "boundary", "viscous", "slope", "rolling", "rolling_power"
        ):  # fmt: skip
            assert (columns[name][idle] == 0.0).all(), name
        for values in (
            out.now.normal_force,
            out.now.damping_power,
            out.now.stiffness_power,
            out.friction.drag.power,
        ):
            assert (values[:meshes][is_open] == 0.0).all()
        assert (out.friction.drag.torque[:, :meshes][:, is_open] == 0.0).all()
        assert np.isfinite(out.force).all() and np.isfinite(out.power).all()
    assert seen.min() > 0
