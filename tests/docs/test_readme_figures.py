"""The table of speed and error in the README has the figures of the last measurement."""

import json

import pytest
from docs.blocks import ROOT

TOLERANCE = 1e-3
MEASURED = json.loads((ROOT / "benchmarks/speed_and_error.json").read_text())
CASES = (
    "steady 1000 rpm",
    "rattle",
    "resonance 17 000 rpm",
    "planar, floating sun",
    "spatial",
)


def row_of(case, method):
    (row,) = (
        row
        for row in MEASURED
        if (row["case"], row.get("method"), row["tolerance"]) == (case, method, TOLERANCE)
    )
    return row


def every_cycle(case):
    if any((row["case"], row.get("method")) == (case, "march") for row in MEASURED):
        row = row_of(case, "march")
        return row["rtf"], row["error_dte"]
    row = row_of(case, "auto")  # moving axes: computed over the same minute
    return row["computed_rtf"], row["computed_error_dte"]


def over_a_minute(case):
    row = row_of(case, "auto")
    return row["rtf"], row["error_dte"]


@pytest.mark.parametrize("case", CASES)
def test_each_speed_has_the_error_of_its_own_method(case):
    cells = [case]
    for speed, error in (every_cycle(case), over_a_minute(case)):
        cells += [f"{float(f'{speed:.3g}'):g}", f"{error:.1e}"]
    assert f"| {' | '.join(cells)} |" in (ROOT / "README.md").read_text().splitlines()
