"""The command, whole, into a folder of its own."""

import json

import pytest
from command_line import invoke, succeed


@pytest.mark.release
def test_the_command_writes_page_pictures_and_figures(tmp_path):
    page, machine = tmp_path / "new" / "side.md", tmp_path / "paper.json"
    succeed("paper", "--out", page, "--json", machine)
    assert page.read_text("utf-8").startswith("# The paper, side by side")
    assert len(list((tmp_path / "new" / "side").glob("figure_*.png"))) == 14
    data = json.loads(machine.read_text("utf-8"))
    points = data["studies"]["paper"]
    study = {(p["backlash"], p["lambda_ratio"], p["speed"]) for p in points if p["torque"] == 63.0}
    assert len(study) == 4 * 5 * 3
    assert all(point["ledger_efficiency"] > 1.0 for point in data["studies"]["paper_printed"])


@pytest.mark.parametrize("out", ["/proc/no/paper.md", "paper"])
def test_a_page_that_cannot_be_written_ends_in_one_line(out):
    result = invoke("paper", "--out", out)
    assert result.exit_code == 2
    assert result.stderr.count("\n") == 1 and out in result.stderr
