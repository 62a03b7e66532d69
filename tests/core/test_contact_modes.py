"""Modes of the contact states, nodes of a step and mean films against what they are defined by."""

import numpy as np
import pytest
from numpy.polynomial import Legendre
from planetary_twin_benchmark.samples import samples_until

from planetary_twin_py import _core
from planetary_twin_py._core import radau
from planetary_twin_py.model.clock import instant
from planetary_twin_py.run.engine import Engine
from planetary_twin_py.scene import load_scene

PAPER = load_scene("paper")
FILM = 4  # row of the film among what is observed
# Flanks part and meet without end, on both sides.
CHAOS = {"input_torque": -20.0, "torque_ripple": 40.0, "backlash": 5e-6, "mesh.runout.planet": 2e-6}


def run(duration, tolerance=1e-3, **changes):
    engine = Engine(PAPER.replace(**changes), tolerance, "march")
    engine.sample(duration)
    return engine


def stiffness_matrix(train, state):
    """K of the bodies and the ground from the rows of meshes and couplings."""
    matrix = np.zeros((train.bodies + 1, train.bodies + 1))
    for i in range(train.meshes):
        row = np.zeros(train.bodies + 1)
        np.add.at(row, train.mesh.body[i], train.mesh.sign[i])
        matrix += state.stiffness[i] * np.outer(row, row)
    for c in range(train.machines):
        row = np.zeros(train.bodies + 1)
        row[train.coupling.ends[c]] = 1.0, -1.0
        matrix += train.coupling.stiffness[c] * np.outer(row, row)
    return matrix[: train.bodies, : train.bodies]


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"gearset.held": "ring", "drive.input.member": "sun", "drive.output.member": "carrier"},
        CHAOS,
    ],
)
def test_modes_have_unit_mass_and_diagonalise_the_stiffness(changes):
    engine = run(0.005, **changes)
    train, known = engine.train, engine.integrator.run.known
    n = train.bodies
    assert known.count > 1
    for k in range(known.count):
        state = known.state(k)
        shapes, square = state.shapes[:n, :n], state.square[:n]
        assert shapes @ np.diag(train.body.mass[:n]) @ shapes.T == pytest.approx(
            np.eye(n), abs=1e-12
        )
        modal = shapes @ stiffness_matrix(train, state) @ shapes.T
        assert modal == pytest.approx(np.diag(square), abs=1e-12 * square.max())
        assert (np.diff(square) >= 0.0).all()


@pytest.mark.parametrize("points", [1, 2, 3, 4, 5])
def test_nodes_are_radaus_points(points):
    nodes = radau(points)
    shape = Legendre.basis(points) - Legendre.basis(points - 1)
    expected = np.sort(0.5 * (1.0 + shape.roots().real))
    assert nodes.abscissa[:points] == pytest.approx(expected, abs=1e-12)
    values = np.vander(nodes.abscissa[:points], increasing=True)
    product = nodes.coefficient[:points, :points] @ values
    assert product == pytest.approx(np.eye(points), abs=1e-12)


@pytest.mark.parametrize("points", [2, 3, 4, 5])
def test_nodes_give_the_legendre_coefficients(points):
    nodes = radau(points)
    expected = np.random.default_rng(points).standard_normal(points)
    values = Legendre(expected, domain=[0.0, 1.0])(nodes.abscissa[:points])
    found = nodes.legendre[:points, :points] @ values
    assert found == pytest.approx(expected, abs=1e-12)


def test_the_mean_film_of_cut_steps_is_that_of_dense_samples():
    begin, duration, rate = 0.01, 0.004, 2e6
    engine = run(begin, 1e-4, **CHAOS)
    now, sums = instant(begin), _core.MeshSums()
    _core.pop_mesh_sums(engine.model, engine.integrator, now, sums)
    before, room = engine.control.flank_events, round(duration * rate)
    shown = samples_until(engine, begin + duration, round(begin * rate) + 1, rate, room)
    now = instant(begin + duration)
    _core.pop_mesh_sums(engine.model, engine.integrator, now, sums)
    assert engine.control.flank_events > before + 10
    film = np.nansum(shown.mesh[:, FILM], axis=0) / rate
    assert sums.integral[FILM, : shown.mesh.shape[2]] == pytest.approx(
        film, rel=0.0, abs=5e-3 * film.max()
    )
