"""The command `fit` as typed."""

import json
from functools import partial

import command_line
import pytest
from studies.fit.rig import PAPER, record

run = partial(command_line.invoke, "fit")
succeed = partial(command_line.succeed, "fit")


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    return record(tmp_path_factory.mktemp("rig") / "bag", PAPER, 0.1, share=0.01)


def test_unidentifiable_parameters_are_a_warning(bag, tmp_path):
    out = tmp_path / "fit.json"
    free = "backlash=4e-7,input-torque=50"
    done = succeed(bag, "--free", free, "--from", 0.02, "--to", 0.09, "--json", out)
    warning = "warning: backlash: not identifiable from this excerpt: teeth never separate"
    assert warning in done.output
    figures = json.loads(out.read_text())
    torque, backlash = (figures["parameters"][name] for name in ("input_torque", "backlash"))
    assert (
        torque["identifiable"]
        and torque["told"]
        and torque["low"] < torque["estimate"] < torque["high"]
    )
    assert torque["estimate"] == pytest.approx(63.0, rel=0.01) and torque["unit"] == "N m"
    assert (
        not backlash["identifiable"]
        and not backlash["told"]
        and backlash["estimate"] is None
        and backlash["low"] == 0.0
    )
    assert (
        figures["not_identifiable"] == figures["untold"] == [["backlash"]]
        and len(figures["remarks"]) == 1
    )
    assert (figures["from_s"], figures["to_s"]) == (0.02, 0.09)
    assert figures["simulations"] > 5 and figures["confidence"] == 0.95


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (["--free", "nosuch"], "nosuch: no such field"),
        (["--free", "backlash", "--from", "7"], "0 intervals from --from to --to"),
        (["--free", "backlash", "--observe", "odd"], "observe = odd: must be one of"),
        (["--free", "backlash", "--noise", "dte_rms=x"], "--noise dte_rms = 'x'"),
        (["--free", "backlash=1 kg"], "backlash"),
        (["--free", ","], "no free parameter"),
    ],
)
def test_invalid_arguments_end_in_one_line(bag, arguments, reason):
    done = run(bag, *arguments)
    assert done.exit_code == 2, done.output
    assert done.output.count("\n") == 1 and reason in done.output
