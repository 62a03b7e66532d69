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


def measured(case, method):
    rows = [
        row
        for row in MEASURED
        if (row["case"], row.get("method"), row["tolerance"]) == (case, method, TOLERANCE)
    ]
    if not rows:  # moving axes: only over a minute
        return "-", "-"
    (row,) = rows
    return f"{row['rtf']:.3g}", f"{row['error_dte']:.1e}"


@pytest.mark.parametrize("case", CASES)
def test_each_speed_has_the_error_of_its_own_method(case):
    cells = (case, *measured(case, "march"), *measured(case, "auto"))
    assert f"| {' | '.join(cells)} |" in (ROOT / "README.md").read_text().splitlines()
