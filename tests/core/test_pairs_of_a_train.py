"""What the tooth pairs of a whole train do: damping by friction, bristles that pass on."""

import numpy as np
import pytest
from planetary_twin_core_parts import (
    PAIR_CAPACITY,
    evaluate,
    friction_damping,
    pass_bristles,
    turn_pairs,
)

from planetary_twin_py._core import BODIES, Evaluation, StepConstants, forces, set_step_constants
from planetary_twin_py.run.engine import Engine
from planetary_twin_py.scene import load_scene


def at_start(scene):
    """Model and state of a run at its start."""
    engine = Engine(scene, 1e-4)
    return engine.model, engine.integrator.begin.copy()


@pytest.mark.parametrize("name", ["paper", "wind_turbine_stage", "differential"])
def test_friction_damps_as_its_slope_along_sliding_of_every_pair(name):
    """The sum of slope dVs/dv dVs/dv^T; the sliding is linear in the speeds of the bodies."""
    model, state = at_start(load_scene(name))
    train, step, out = model.train, StepConstants(), Evaluation()
    set_step_constants(model, state, step)
    forces(model, state, step, state.x, state.v, 0.0, state.trim, out)
    pairs, bodies = out.pairs, int(train.bodies)
    count, meshes = int(pairs.count), int(train.meshes)
    slope = pairs.slope[:count].copy()
    matrix = np.zeros((BODIES, BODIES))
    friction_damping(train, pairs, np.zeros(BODIES), 0.0, matrix)

    def sliding(v):
        turn_pairs(train, step, v, pairs)
        evaluate(model, pairs)
        return pairs.sliding[:count].copy()

    still = sliding(np.zeros(BODIES))
    rows = np.array([sliding(np.eye(BODIES)[j]) - still for j in range(bodies)]).T
    copies = np.array([train.mesh.copies[k % meshes] for k in range(count)])
    expected = (rows * (copies * slope)[:, None]).T @ rows
    assert np.abs(expected).max() > 0.0
    close = 1e-9 * np.abs(expected).max()
    assert matrix[:bodies, :bodies] == pytest.approx(expected, rel=1e-9, abs=close)


@pytest.mark.parametrize("kind", [0, 1])
def test_bristles_stay_with_their_teeth_through_a_whole_cycle(kind):
    """Forth and back over every edge a pair that is there on both sides keeps its share."""
    model, _ = at_start(load_scene("paper"))
    train = model.train
    meshes, slots = int(train.meshes), int(train.teeth.slots)
    mesh = kind * meshes // 2
    others = [k for k in range(slots * meshes) if k % meshes != mesh]
    count = int(train.teeth.segments[kind])
    for segment in range(count):
        share = np.zeros(PAIR_CAPACITY)
        share[others] = 0.25
        own = [p * meshes + mesh for p in range(int(train.teeth.present[kind, segment]))]
        share[own] = 0.5 + np.arange(len(own)) / 8
        after = (segment + 1) % count
        wrap = 1.0 if after == 0 else 0.0
        teeth = {train.teeth.shift[kind, segment, p]: share[own[p]] for p in range(len(own))}
        passed = share.copy()
        pass_bristles(train, passed, mesh, segment, 1)
        there = int(train.teeth.present[kind, after])
        expected = [teeth.get(train.teeth.shift[kind, after, p] - wrap, 0.0) for p in range(there)]
        assert passed[mesh : there * meshes : meshes].tolist() == expected
        assert (passed[others] == 0.25).all()
        assert np.count_nonzero(expected) >= 1  # a mesh never goes without a tooth pair
        back = passed.copy()
        pass_bristles(train, back, mesh, after, -1)
        kept = [k for k in own if back[k] != 0.0]
        assert kept and (back[kept] == share[kept]).all()
