"""Records of the core in Python: where they lie, what they hold, and what they refuse."""

import copy
import inspect

import numpy as np
import pytest
from planetary_twin_core_parts import Problem

from planetary_twin_py import _core
from planetary_twin_py._core import (
    BodyArrays,
    Equilibrium,
    Evaluation,
    Integrator,
    MeshArrays,
    MeshCycle,
    Model,
    State,
    Train,
)

CACHE_LINE = 64  # [bytes] vector registers that straddle two lines take twice as long to load
RECORDS = [kind for _, kind in inspect.getmembers(_core, inspect.isclass) if hasattr(kind, "raw")]


def fields_of(kind):
    return [
        name for name, _ in inspect.getmembers(kind, lambda member: isinstance(member, property))
    ]


def large_fields(record, name=""):
    """Name and address of every array of a cache line or more, within records in records too."""
    for field in fields_of(type(record)):
        value = getattr(record, field)
        if isinstance(value, np.ndarray) and value.nbytes >= CACHE_LINE:
            yield f"{name}{field}", value.ctypes.data
        elif hasattr(value, "raw"):
            yield from large_fields(value, f"{name}{field}.")


@pytest.mark.parametrize("kind", [Evaluation, Model, Integrator, Equilibrium, Problem])
def test_what_fills_a_cache_line_begins_with_one(kind):
    places = dict(large_fields(kind()))
    assert len(places) > 5
    assert {name for name, place in places.items() if place % CACHE_LINE} == set()


@pytest.mark.parametrize("kind", RECORDS, ids=lambda kind: kind.__name__)
def test_a_new_record_is_zero_and_its_copy_is_another(kind):
    record = kind()
    for field in fields_of(kind):
        value = getattr(record, field)
        if isinstance(value, np.ndarray | int | float):
            assert not np.any(value), field
    assert type(copy.copy(record)) is kind
    assert record.copy().raw().ctypes.data != record.raw().ctypes.data


def test_a_new_record_holds_what_it_is_given_and_zeros():
    train = Train(
        cycle=MeshCycle(sun_advance=2.0),
        body=BodyArrays(mass=[1.0, 2.0]),
        mesh=MeshArrays(body=np.ones((2, 2), dtype=int)),
    )
    assert train.cycle.sun_advance == 2.0
    assert np.array_equal(train.body.mass, [1.0, 2.0, *[0.0] * (_core.BODIES - 2)])
    assert train.mesh.body.sum() == 4 and np.array_equal(train.mesh.body[:2, :2], np.ones((2, 2)))


def test_arrays_and_inner_records_are_the_records_own():
    model = Model(train=Train(body=BodyArrays(mass=[1.0])))
    mass = model.train.body.mass
    mass[0] = 3.0
    assert model.train.body.mass[0] == 3.0
    kept = model.copy()
    mass[0] = 4.0
    assert (kept.train.body.mass[0], model.train.body.mass[0]) == (3.0, 4.0)
    del model
    assert mass[0] == 4.0  # the array keeps its record alive


def test_what_does_not_fit_is_refused():
    with pytest.raises(AttributeError):
        Train(massive=True)
    with pytest.raises(AttributeError):
        State().tim = 1.0
    with pytest.raises(ValueError):
        BodyArrays(mass=np.ones(_core.BODIES + 1))
    with pytest.raises(TypeError):
        State(time="late")
