"""The picture shows the rows of one measurement and nothing else."""

import math

import numpy as np
from planetary_twin_benchmark.table import Row
from planetary_twin_benchmark.work_precision import work_precision


def row(case, method, tolerance, error, rtf, note=""):
    nan = math.nan
    return Row(case, method, tolerance, error, nan, nan, nan, nan, rtf, nan, note=note)


ROWS = [
    row("steady", "march", 1e-2, 1e-3, 20.0),
    row("steady", "march", 1e-3, 1e-4, 10.0),
    row("steady", "lsoda", 1e-2, 2e-2, 0.5),
    row("steady", "radau", 1e-2, math.nan, math.nan, "over 15 s"),
    row("rattle", "march", 1e-2, 3e-3, 8.0),
]


def test_every_case_has_a_panel_with_the_rows_that_have_figures():
    panes = work_precision(ROWS).axes
    assert [axes.get_title(loc="left") for axes in panes] == ["steady", "rattle"]
    lines = {line.get_label(): line for line in panes[0].get_lines() if len(line.get_xdata())}
    assert list(lines) == ["march", "lsoda"]
    np.testing.assert_allclose(lines["march"].get_xdata(), [0.05, 0.1])
    np.testing.assert_allclose(lines["march"].get_ydata(), [1e-3, 1e-4])
    assert panes[0].get_xscale() == panes[0].get_yscale() == "log"


def test_many_cases_are_arranged_in_rows_and_methods_are_distinguishable():
    rows = [row(f"case {c}", f"m{m}", 1e-2, 1e-3, 1.0 + m) for c in range(5) for m in range(9)]
    figure = work_precision(rows)
    assert len(figure.axes) == 5
    styles = {(line.get_color(), line.get_marker()) for line in figure.axes[0].get_lines()}
    assert len(styles) == 9
