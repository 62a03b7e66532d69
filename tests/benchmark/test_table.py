"""Speed never comes without its error: both from one run, the error against another method."""

import json
import math

import pytest

from planetary_twin_py.benchmark.cases import Case
from planetary_twin_py.benchmark.report import as_markdown
from planetary_twin_py.benchmark.table import measure

SHORT = Case("short", {}, 0.002, 2)
RATTLE = Case("rattle", {"input_torque": 0.3, "torque_ripple": 60.0}, 0.004, 2)


@pytest.mark.parametrize("case", [SHORT, RATTLE], ids=lambda case: case.name)
def test_the_error_against_the_reference_is_that_of_the_tolerance(case):
    rows = measure([case], (1e-3, 1e-5))
    assert rows[1].error_dte < rows[0].error_dte
    for row in rows:
        assert 0.0 < row.error_dte < 3.0 * row.tolerance
        assert 0.0 < row.error_power_loss < 3.0 * row.tolerance
    assert all(row.rtf_low <= row.rtf <= row.rtf_high for row in rows)


def test_the_page_of_the_documentation_shows_what_was_measured():
    (row,) = measure([SHORT], (1e-3,))
    errors = f"{row.error_dte:.1e} | {row.error_power_loss:.1e}"
    cells = f"| short | {row.method} | 1e-03 | {errors} | {row.rtf:.3g} |"
    assert cells in as_markdown([row]) and math.isfinite(row.rtf)


def test_figures_are_json_also_without_friction():
    case = Case("smooth", {"lubrication.friction": False}, 0.001, 1)
    (row,) = measure([case], (1e-2,))
    assert json.loads(json.dumps(row.figures(), allow_nan=False))["error_power_loss"] is None
