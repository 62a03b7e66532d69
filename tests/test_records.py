"""Records in memory: what fills a cache line begins with one, at every depth."""

import numpy as np
import pytest

from planetary_twin_py._records import CACHE_LINE, REAL, SMALL, WHOLE, layout, new_record
from planetary_twin_py.benchmark.peers.equations import PROBLEM
from planetary_twin_py.dynamics.equations import EVALUATION, MODEL
from planetary_twin_py.dynamics.moment import MOMENT
from planetary_twin_py.integrators.progress import MARCH
from planetary_twin_py.quasi_static.equilibrium import EQUILIBRIUM

LAYOUTS = {
    "evaluation": EVALUATION,
    "model": MODEL,
    "moment": MOMENT,
    "march": MARCH,
    "equilibrium": EQUILIBRIUM,
    "problem": PROBLEM,
}


def large_fields(kind, begin=0, name=""):
    """Name and place of every field of a cache line or more, within records in records too."""
    for field in kind.names:
        inner, offset = kind.fields[field][:2]
        if inner.itemsize >= CACHE_LINE:
            yield f"{name}{field}", begin + offset
        base, count = inner.base, inner.itemsize // inner.base.itemsize
        if base.names is not None:
            for n in range(count):
                place = begin + offset + n * base.itemsize
                yield from large_fields(base, place, f"{name}{field}.")


@pytest.mark.parametrize("kind", LAYOUTS.values(), ids=LAYOUTS)
def test_what_fills_a_cache_line_begins_with_one(kind):
    record = new_record(kind)
    first = record.view(np.uint8).ctypes.data if hasattr(record, "ctypes") else None
    begin = record.__array_interface__["data"][0] if first is None else first
    places = dict(large_fields(kind, begin))
    assert len(places) > 5
    assert {name for name, place in places.items() if place % CACHE_LINE} == set()


def test_records_in_an_array_stay_aligned():
    kind = layout(flag=SMALL, values=(REAL, (3,)), many=(REAL, (9,)), count=WHOLE)
    outer = layout(one=WHOLE, inner=(kind, (3,)))
    assert kind.itemsize % CACHE_LINE == 0
    record = new_record(outer)
    addresses = [record.inner[n].many.ctypes.data for n in range(3)]
    assert [address % CACHE_LINE for address in addresses] == [0, 0, 0]
    assert kind.fields["values"][1] % 8 == 0


def test_a_new_record_holds_what_it_is_given_and_zeros():
    kind = layout(scale=REAL, values=(REAL, (10,)), table=(WHOLE, (3, 4)))
    record = new_record(kind, scale=2.0, values=[1.0, 2.0], table=np.ones((2, 2), dtype=int))
    assert record.scale == 2.0
    assert np.array_equal(record.values, [1.0, 2.0, *[0.0] * 8])
    assert record.table.sum() == 4 and np.array_equal(record.table[:2, :2], np.ones((2, 2)))
