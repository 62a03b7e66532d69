"""Speed at equal error: the fastest run that is accurate enough, or no figure."""

import math

from planetary_twin_benchmark.equal_error import equal_error_markdown, fastest, without_samples
from planetary_twin_benchmark.steady import Steady
from planetary_twin_benchmark.table import Row
from planetary_twin_benchmark.timing import Speed


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


def test_the_page_shows_speeds_and_ratios():
    minute = Steady("case", 1e-3, 1.0, 0.0, 2e-5, 0.0, Speed(300.0, 290.0, 310.0), 0.0)
    page = equal_error_markdown(ROWS, [minute])
    for error, bare, sampled in (
        ("1e-03", "20 | 10 (2) | 1 (20) | - | 300", "10 | 5 (2) | 0.5 (20) | -"),
        ("1e-06", "- | - | - | - | -", "- | - | - | -"),
    ):
        section = page.split(f"### DTE error at most {error}\n")[1].split("###")[0]
        first, second = section.split("With samples")
        assert f"| case | {bare} |" in first and f"| case | {sampled} |" in second


def test_without_peers_there_is_nothing_to_compare():
    assert equal_error_markdown(ROWS[:2], []) == ""
