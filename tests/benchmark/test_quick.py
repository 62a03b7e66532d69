"""`bench --quick`: the table of the README, with the ratio to CVODE at equal error."""

import json
from importlib.util import find_spec

import pytest
from planetary_twin_benchmark import machine, quick, quick_table, steady
from planetary_twin_benchmark.cases import FRICTIONLESS, PLANAR, RECTANGULAR, Case
from typer.testing import CliRunner

from planetary_twin_py.cli import build_app

pytestmark = pytest.mark.slow

SMOOTH = Case("smooth", RECTANGULAR | FRICTIONLESS, 0.002, 1)
MOVING = Case("moving", PLANAR, 0.0005, 1)


@pytest.fixture(autouse=True)
def _short_runs(monkeypatch):
    monkeypatch.setattr(quick, "QUICK_CASES", (SMOOTH, MOVING))
    monkeypatch.setattr(quick, "COMPARED_AT", {"smooth": 1e-4})
    monkeypatch.setattr(quick, "ROUNDS", 2)
    monkeypatch.setattr(steady, "BY", 0.02)
    monkeypatch.setattr(steady, "COMPARED", 0.005)


def invoke(*arguments):
    return CliRunner().invoke(build_app(), ["bench", "--quick", *arguments], env={"COLUMNS": "140"})


@pytest.mark.skipif(find_spec("sksundae") is None, reason="needs the extra [bench]")
def test_the_ratio_is_at_equal_error(tmp_path):
    page = tmp_path / "page.md"
    answer = invoke("--json", str(tmp_path / "figures.json"), "--markdown", str(page))
    assert answer.exit_code == 0, answer.output
    rows = json.loads((tmp_path / "figures.json").read_text())
    own, *peers = rows[1:4]
    assert [row["method"] for row in rows[:5]] == ["march", "march", *quick.PEERS, "auto"]
    assert all(0.0 < row["error_dte"] <= 1e-4 for row in (own, *peers))
    low, high = own["times_cvode"][1:]
    fastest = max(row["rtf_high"] for row in peers)
    assert own["rtf_low"] / fastest <= low <= high
    assert rows[5]["case"] == "moving" and 0.0 < rows[5]["error_dte"] < 1e-3
    cells = f"| smooth | {rows[0]['rtf']:.3g} | {rows[0]['error_dte']:.1e} |"
    assert page.read_text().startswith(f"**{machine.code()}**, {machine.machine()[:4]}")
    assert cells in page.read_text() and "| moving |" in page.read_text()


def test_without_cvode_a_line_says_what_is_missing(monkeypatch):
    for module in (quick, quick_table):
        monkeypatch.setattr(module, "peers_installed", lambda: False)
    answer = invoke()
    assert answer.exit_code == 0, answer.output
    assert "times CVODE needs scikit-sundae: pip install" in answer.stdout


@pytest.mark.parametrize("option", ["--peers", "--costs"])
def test_quick_has_one_table(option):
    answer = invoke(option)
    assert answer.exit_code == 2
    assert "--quick: has one table" in answer.stderr
