"""Compensated sums of many small terms."""

import math

import numpy as np
import pytest

from planetary_twin_py.durability.sums import Sums

TERMS = np.random.default_rng(0).lognormal(-30.0, 4.0, (20_000, 3))


def test_total_is_the_correctly_rounded_sum():
    sums = Sums.zero(3)
    sums.add(TERMS)
    assert sums.total.tolist() == [math.fsum(column) for column in TERMS.T]
    assert np.add.accumulate(TERMS)[-1].tolist() != sums.total.tolist()  # plain sums are not


@pytest.mark.parametrize("seed", range(5))
def test_sums_of_any_parts_have_the_same_bits(seed):
    at_once, in_parts = Sums.zero(3), Sums.zero(3)
    at_once.add(TERMS)
    cuts = np.sort(np.random.default_rng(seed).integers(0, len(TERMS), 50))
    for part in np.split(TERMS, cuts):
        in_parts.add(part)
    assert in_parts.sum.tobytes() == at_once.sum.tobytes()
    assert in_parts.compensation.tobytes() == at_once.compensation.tobytes()


def test_a_term_that_one_addition_loses_is_kept():
    sums = Sums.zero()
    sums.add([1.0, *[1e-17] * 1000])
    assert float(sums.total) == 1.0 + 1e-14
    assert float(sums.sum) == 1.0
