"""`planetary-twin run --plant` plays a plant, follows it, records both and shows what was found."""

import functools
import json
from pathlib import Path

import pytest
from tiers import first_rows

from ..peer import TWIN
from ..programs import ended, outcome
from ..recordings import counts
from .conftest import Run

HIDDEN = """
sensors:
  input_torque: {noise: 0.1 N m}
  output_torque: {noise: 0.25 N m}
  speed_noise: 0.02 rad/s
  vibration: {rate: 4 kHz, packet: 40}
changes: [{at: 6 s, friction: 1.5}]
"""


@pytest.fixture
def run_plant(run: Run, tmp_path: Path) -> Run:
    """Start `planetary-twin run --plant paper` with options."""
    (tmp_path / "hidden.yaml").write_text(HIDDEN)
    return functools.partial(run, "--plant", "paper")


@pytest.mark.exhaustive
def test_a_hidden_change_is_found_shown_and_recorded(run_plant, tmp_path):
    process = run_plant("--hidden", "hidden.yaml", "--duration", "10", "--record", "rig",
                   "--json", "out.json")  # fmt: skip
    output, _ = outcome(process)
    assert "loss torque stepped" in output and "IDENTIFIABLE" in output
    figures = json.loads((tmp_path / "out.json").read_text())
    (step,) = (one for one in figures["events"] if one["what"] == "loss torque stepped")
    assert 6.0 < step["found"] < 10.0 and step["since"] < step["found"]
    assert figures["estimates"]["input_torque"]["status"] == "ESTIMATED"
    recorded = counts(tmp_path / "recordings" / "rig")
    assert recorded[f"{TWIN}/measured/joint_states"] == 1000
    assert recorded[f"{TWIN}/measured/vibration"] == 1000
    assert recorded[f"{TWIN}/follower/estimate"] > 50
    assert recorded[f"{TWIN}/follower/event"] >= 1


@pytest.mark.parametrize(
    ("options", "line"),
    first_rows(
        1,
        [
            (("--hidden", "none.yaml"), "none.yaml: No such file or directory"),
            (
                ("--set", "backlash=1e-7"),
                "--plant: --set, --param, --rate-factor, --tolerance, --durability are options",
            ),
            (("--duration", "inf"), "--duration = inf s: must be at most 86400 s"),
        ],
    ),
)
def test_invalid_options_are_refused_in_one_line(run_plant, options, line):
    process = run_plant(*options)
    errors = ended(process, 2)
    assert line in errors.strip().splitlines()[-1]
