"""The command `bench`: one run fills table, page, figures and picture."""

import json
from functools import partial

import command_line
import pytest
from planetary_twin_benchmark import batch, cases, costs, steady, table


@pytest.fixture(autouse=True)
def _short_runs(monkeypatch):
    monkeypatch.setattr(cases, "CASES", (cases.Case("short", {}, 0.001, 1),))
    monkeypatch.setattr(table, "WHOLE", 0.002)
    monkeypatch.setattr(steady, "BY", 0.02)
    monkeypatch.setattr(costs, "SHORTEST", 0.001)
    monkeypatch.setattr(costs, "LONGEST", 0.001)
    monkeypatch.setattr(costs, "DURATIONS", (0.001,))
    measure = batch.measure_batch
    monkeypatch.setattr(batch, "measure_batch", lambda progress: measure([(0.001, 1)], progress))


invoke = partial(command_line.invoke, "bench", COLUMNS="120")
succeed = partial(command_line.succeed, "bench", COLUMNS="120")


@pytest.mark.slow
def test_page_figures_and_picture_come_from_one_run(tmp_path):
    page, figures = tmp_path / "docs" / "page.md", tmp_path / "figures.json"
    picture = tmp_path / "docs" / "work.png"
    page.parent.mkdir()
    answer = succeed(
        "--costs", "--markdown", str(page), "--plot", str(picture), "--json", str(figures)
    )
    rows = json.loads(figures.read_text())
    text = page.read_text()
    assert [(row["method"], row["tolerance"]) for row in rows] == [
        (method, tolerance) for method in table.METHODS for tolerance in table.TOLERANCES
    ]
    for row in rows:
        assert f" {row['rtf']:.3g} " in answer.stdout
    assert "| short | " in text
    assert "(work.png)" in text and picture.read_bytes().startswith(b"\x89PNG")
    assert all(f"| {against}" in text for against in costs.TABLES)


def test_a_picture_that_cannot_be_written_ends_in_one_line():
    answer = invoke("--plot", "/nowhere/work.png")
    assert answer.exit_code == 2
    assert "/nowhere/work.png" in answer.stderr
