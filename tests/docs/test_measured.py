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


@pytest.mark.release
def test_the_command_gives_the_same_verdicts(tmp_path):
    command = [sys.executable, "-m", "measured", tmp_path / "measured.md"]
    subprocess.run(command, cwd=ROOT / "benchmarks", check=True, timeout=1800)
    assert rows((tmp_path / "measured.md").read_text()) == rows(PAGE.read_text())
