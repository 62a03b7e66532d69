"""A minute of steady running: speed and error once mesh cycles repeat."""

import math

import pytest
from planetary_twin_benchmark import steady
from planetary_twin_benchmark.cases import FRICTIONLESS, RECTANGULAR, Case
from planetary_twin_benchmark.steady import measure_steady, steady_markdown, steady_table


@pytest.fixture(autouse=True)
def _settle_soon(monkeypatch):
    monkeypatch.setattr(steady, "BY", 0.8)


def test_repeated_cycles_are_within_the_tolerance():
    (row,) = measure_steady([Case("smooth", RECTANGULAR | FRICTIONLESS, 0.01, 1)], [1e-3])
    assert 0.3 < row.repeats_from < 0.8
    assert 0.0 < row.error_dte < 1e-3
    assert abs(row.late) < 1e-3
    assert row.speed.low <= row.speed.median <= row.speed.high
    cells = f"| smooth | {row.repeats_from:.2f} s | {row.late:.0e} | {row.error_dte:.1e} |"
    assert cells in steady_markdown([row])
    assert 0.0 < row.computed_error_dte < 1e-3
    assert row.computed.low <= row.computed.median <= row.computed.high
    assert f" | {row.computed_error_dte:.1e} |\n" in steady_markdown([row])
    figures = row.figures()
    assert figures["method"] == "auto" and figures["error_power_loss"] is None
    assert figures["rtf_low"] <= figures["rtf"] <= figures["rtf_high"] and figures["setup_s"] > 0.0


def test_motion_that_does_not_repeat_has_no_figures():
    (row,) = measure_steady([Case("standstill", {"input_speed": 0.0}, 0.01, 1)], [1e-3])
    assert math.isnan(row.repeats_from) and math.isnan(row.speed.median)
    assert "| never | - |" in steady_markdown([row])
    assert steady_table([row]).row_count == 1
