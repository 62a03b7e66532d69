"""Loads of tooth pairs from the force of their mesh, against what the equations of motion have."""

import math

import numpy as np
import pytest
from tiers import first_rows

import planetary_twin_py as pt
from planetary_twin_py._core import Evaluation, StepConstants, forces, set_step_constants
from planetary_twin_py.model.gearbox import Gearbox
from planetary_twin_py.model.pair_loads import pair_loads
from planetary_twin_py.run.start import start

PAPER = pt.load_scene("paper")
CRACKED = pt.load_scene("cracked_tooth")
STEP = 0.7e-3  # [s] about a third of a mesh cycle at 1000 rpm
TURN = 30 * 2e-3  # [s] of the sun, which meets each of its teeth once a turn


def model_loads(engine):
    """Angles; forces (meshes,), positions and loads (meshes, pairs) in the model's own state."""
    model, state, train = engine.model, engine.integrator.end, engine.train
    moment, work = StepConstants(), Evaluation()
    set_step_constants(model, state, moment)
    forces(model, state, moment, state.x, state.v, 0.0, state.trim, work)
    bodies, shown = engine.gearbox.body_names, engine.gearbox.mesh_names.place
    turns = 2 * math.pi * train.body.ratio @ (state.turns + state.fraction)
    angle = (turns + state.x * train.body.inverse_radius)[bodies.place]
    slots, meshes = int(train.teeth.slots), int(train.meshes)
    loads = work.pairs.load[: slots * meshes].reshape(slots, meshes).T
    rows = zip(train.mesh.kind[:meshes], state.segment[:meshes], strict=True)
    shift = np.array([train.teeth.shift[kind, segment, :slots] for kind, segment in rows])
    positions = moment.start[:meshes, None] + shift
    angles = {name: np.array([value]) for name, value in zip(bodies.names, angle, strict=True)}
    return angles, (state.side * work.now.normal_force)[shown], positions[shown], loads[shown]


def loads_at(places, positions, loads):
    """Loads [N] of the pairs at `places`, whatever slots they are in; slots without a pair have 0.

    A state at which a pair has just entered stands on the edge of two segments, each with slots of
    its own.
    """
    near = np.abs(positions - places[:, None]) < 1e-3
    return (near * loads).sum(axis=1)


def largest_difference(scene, duration):
    """Of the loads from those of the model and of a healthy set, over the largest force."""
    engine, healthy = start(scene, 1e-4, "march"), Gearbox(scene.replace(faults=[]))
    wrong, effect, largest = 0.0, 0.0, 0.0
    for k in range(1, round(duration / STEP)):
        engine.sample(k * STEP)
        angle, force, positions, expected = model_loads(engine)
        turned = {name: np.mod(value, 2 * math.pi) for name, value in angle.items()}
        for mesh in range(len(force)):
            given = np.array([force[mesh]])
            found = pair_loads(engine.gearbox, mesh, turned, given)
            without = pair_loads(healthy, mesh, turned, given).load
            assert found.load.sum() == pytest.approx(abs(force[mesh]))
            places = positions[mesh]
            drawn = loads_at(places, found.position[0], found.load[0])
            model = loads_at(places, places, expected[mesh])
            wrong = max(wrong, np.abs(drawn - model).max())
            effect = max(effect, np.abs(found.load - without).max())
        largest = max(largest, np.abs(force).max())
    return wrong / largest, effect / largest


CRACK = {"kind": "crack", "stiffness_loss": 0.5}
SPALL = {"kind": "spall", "stiffness_loss": 0.5, "begin": -0.4, "end": 0.4}


@pytest.mark.parametrize(
    ("scene", "duration"),
    first_rows(
        2,
        [
            (
                PAPER.replace(
                    faults=[SPALL | {"gear": "sun", "tooth": 2}, CRACK | {"gear": "sun"}]
                ),
                TURN,
            ),
            (CRACKED.replace(input_torque=-63.0), 1.2 * TURN),
            (CRACKED, 1.2 * TURN),
            (PAPER.replace(faults=[CRACK | {"gear": "ring", "tooth": 3}]), 0.15),
            (PAPER.replace(faults=[CRACK | {"gear": "planet", "planet": 2, "tooth": 4}]), TURN),
        ],
    ),
    ids=["spall and crack", "coast", "cracked_tooth", "ring", "planet"],
)
def test_loads_are_those_of_the_model_while_faulty_teeth_pass(scene, duration):
    wrong, effect = largest_difference(scene, duration)
    assert wrong < 1e-6  # events are located to about 1e-8 of a cycle
    assert effect > 0.02


def shared(depth, force, cycle):
    """Loads of worn tooth 0 of the sun, `cycle` past the pitch point, and of the tooth after it."""
    wear = {"kind": "wear", "gear": "sun", "tooth": 0, "depth": depth}
    angle = 2 * math.pi * cycle / 30
    turned = {"sun": angle, "ring": -3 / 7 * angle, "carrier": 0.0}
    turned |= {f"planet_{i}": -1.5 * angle for i in (1, 2, 3)}
    given = {name: np.array([value]) for name, value in turned.items()}
    found = pair_loads(Gearbox(PAPER.replace(faults=[wear])), 0, given, np.array([force]))
    return loads_at(np.array([cycle, cycle - 1.0]), found.position[0], found.load[0])


def test_a_worn_tooth_leaves_its_load_to_the_next():
    """Two equal springs k of which one begins late by w: they carry F/2 -+ k w/2."""
    stiffness, force, depth = 1.75 / 2 * 2e8, 1500.0, 2e-6  # [N/m] of each of two pairs
    expected = [(force - stiffness * depth) / 2, (force + stiffness * depth) / 2]
    assert shared(depth, force, 0.5) == pytest.approx(expected)


def test_tooth_worn_further_than_the_mesh_yields_carries_nothing():
    worn, healthy = shared(1e-4, 1500.0, 0.5)
    assert worn == 0.0
    assert healthy == pytest.approx(1500.0)
