"""The page of measured figures equals the output of its command."""

import subprocess
import sys

import pytest
from docs.blocks import ROOT

PAGE = ROOT / "docs/measured.md"


def rows(text):
    """Figure and verdict of each row of the tables."""
    cells = [line.strip("| ").split(" | ") for line in text.splitlines() if line.startswith("| ")]
    return [(row[0], row[-1]) for row in cells]


def test_every_miss_and_every_doubt_has_a_reason():
    text = PAGE.read_text()
    doubtful = [figure for figure, verdict in rows(text) if verdict in ("**misses**", "undecided")]
    remarks = [line for line in text.splitlines() if line.startswith("- *")]
    assert doubtful
    for figure in doubtful:
        assert any(figure in remark.split("*: ")[0] for remark in remarks), figure


@pytest.mark.release
def test_the_command_gives_the_same_verdicts(tmp_path):
    command = [sys.executable, "-m", "measured", tmp_path / "measured.md"]
    subprocess.run(command, cwd=ROOT / "benchmarks", check=True, timeout=1800)
    assert rows((tmp_path / "measured.md").read_text()) == rows(PAGE.read_text())
