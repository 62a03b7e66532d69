"""Speed at equal error: the fastest run that is accurate enough, or no figure."""

import math

from planetary_twin_benchmark.equal_error import fastest, without_samples
from planetary_twin_benchmark.table import Row


def row(method, error, speed, note=""):
    bare = 2.0 * speed
    return Row("case", method, 1e-3, error, 0.0, bare, bare, bare, speed, 0.0, note=note)


ROWS = [
    row("march", 5e-4, 10.0),
    row("march", 5e-5, 8.0),
    row("cvode_bdf", 9e-4, 5.0),
    row("cvode_adams_compiled", 2e-3, 50.0),
    row("scipy_lsoda", 1e-5, 0.5),
    row("rk4", 1e-9, 100.0),
    row("semi_implicit_euler", math.nan, math.nan, "unstable"),
]


def test_the_fastest_run_that_is_accurate_enough_counts():
    assert fastest(ROWS, 1e-3, ("march",)) == 10.0
    assert fastest(ROWS, 1e-4, ("march",)) == 8.0
    assert fastest(ROWS, 1e-3, ("cvode",)) == 5.0
    assert math.isnan(fastest(ROWS, 1e-4, ("cvode",)))
    assert fastest(ROWS, 1e-4, ("march",), without_samples) == 16.0
