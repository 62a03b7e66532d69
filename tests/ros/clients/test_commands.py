"""A twin is read, changed and watched on a machine without the `ros2` command."""

import math
from collections.abc import Callable
from pathlib import Path
from subprocess import CompletedProcess

import pytest
from planetary_twin.clients.monitor import FIGURES, beside_rows, pairs
from planetary_twin_msgs.msg import FollowerEstimate, FollowerEvent, GearboxState

from ..programs import Forked

Command = Callable[..., CompletedProcess[str]]


@pytest.fixture
def command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Command:
    """The result of `planetary-twin` with arguments, which must not take long."""
    monkeypatch.delenv("COLUMNS", raising=False)

    def run(*arguments: str) -> CompletedProcess[str]:
        process = Forked("planetary_twin_py.cli", *arguments, cwd=tmp_path)
        output, errors = process.communicate(60.0)
        return CompletedProcess(arguments, process.wait(), output, errors)

    return run


def test_values_may_have_units_and_the_result_is_printed(command, user, points):
    answer = command("param", "set", "backlash", "0.3 um")
    assert (answer.returncode, answer.stdout.strip()) == (
        0,
        "backlash = 3e-07 m (0.3 um)",
    ), answer.stderr
    user.until(lambda: points[-1].backlash == pytest.approx(3e-7))
    assert command("param", "get", "backlash").stdout.strip() == "3e-07"
    answer = command("op", "input_speed=2000 rpm", "lambda_ratio=1.5")
    assert answer.returncode == 0 and answer.stdout.startswith("input_speed, lambda_ratio from ")
    user.until(lambda: points[-1].lambda_ratio == 1.5)
    assert points[-1].input_speed == pytest.approx(2000 * math.pi / 30)
    assert set(points[-1].changed.split(",")) == {"input_speed", "lambda_ratio"}
    assert answer.stderr == ""
    answer = command("op", "input_speed=100", "lambda_ratio=1.5")
    echo = "input_speed = 100 rad/s (954.9 rpm): no unit is given, so this is SI"
    assert answer.stderr.strip() == f"planetary-twin: {echo}"


def test_without_a_twin_in_the_namespace_others_are_named(command, points):
    assert points
    answer = command("param", "get", "backlash", "--namespace", "/elsewhere")
    assert answer.returncode != 0 and answer.stderr.count("\n") == 1
    assert "there is one in /planetary_twin: choose with --namespace" in answer.stderr


def test_values_may_be_negative(command, points):
    for typed in ("-104 rad/s", "-104", "-1e2"):
        answer = command("param", "set", "input_speed", typed)
        assert answer.returncode == 0, answer.stderr
    assert answer.stdout == "input_speed = -100 rad/s (-954.9 rpm)\n"


def test_every_parameter_is_listed_with_its_range(command, points):
    listed = command("param", "list").stdout
    for words in ("backlash", "0 to 0.001", "compute_share", "fixed", "publish_rate"):
        assert words in listed
    assert "qos_overrides" not in listed
    names = [line.split()[0] for line in listed.splitlines()[1:] if line[0] != " "]
    # Those that may change now are first.
    assert names.index("torque_ripple") < names.index("autostart")
    assert names.index("backlash") < names.index("torque_ripple")
    (line,) = [line for line in listed.splitlines() if line.startswith("backlash ")]
    assert "0 to 0.001" in line and line.rstrip().endswith("[m]")


def test_invalid_arguments_end_in_one_line(command, points):
    for arguments, reason in (
        (("param", "set", "backlash", "-1"), "backlash = -1.0 m: must be a number within 0 and"),
        (("param", "set", "scene", "other"), "scene"),
        (("param", "get", "gap"), "gap: no such parameter"),
        (("op", "gap=1"), "gap: no such quantity"),
        (("op", "drive.input.port=torque"), "planetary-twin param set drive.input.port VALUE"),
        (("op", "backlash"), "NAME=VALUE"),
        (
            ("op", "input_speed=20000 rpm"),
            "input_speed = 2094.4 rad/s: must be a number within -1100 and 1100 rad/s "
            "(-10504.2 rpm to 10504.2 rpm)",
        ),
    ):
        answer = command(*arguments)
        assert answer.returncode == 2, answer.stdout
        assert len(answer.stderr.strip().splitlines()) == 1 and reason in answer.stderr
    assert len(points) == 1


def test_a_command_reports_that_no_twin_runs(command, domain):
    for arguments in (("param", "list"), ("monitor",)):
        answer = command(*arguments)
        assert answer.returncode == 1 and "no twin" in answer.stderr, answer.stderr


def test_the_monitor_shows_every_figure(command, points):
    answer = command("monitor", "--duration", "2.5")
    assert answer.returncode == 0, answer.stderr
    for figure in FIGURES:
        assert figure.title in answer.stdout
    assert answer.stdout.count("Speed of the motor") >= 2
    assert "1000 " in answer.stdout and "Mesh cycles" in answer.stdout


def estimate() -> FollowerEstimate:
    return FollowerEstimate(
        input_torque=62.5, input_speed=-104.0, loss_torque=0.75, friction_level=1.1,
        friction_level_low=0.9, friction_level_high=1.3,
    )  # fmt: skip


def test_residuals_are_measured_less_simulated():
    state = GearboxState(input_torque=63.0, input_speed=-104.0, power_loss=70.0)
    torque, speed, loss = pairs(estimate(), state)
    assert torque.residual == -0.5 and speed.residual == 0.0
    assert loss.measured == 78.0 and loss.residual == 8.0


def test_what_is_not_identifiable_is_named():
    unknown = estimate()
    unknown.friction_level, unknown.loss_torque = math.nan, math.nan
    unknown.friction_level_status = "NOT_IDENTIFIABLE"
    event = FollowerEvent(what="sun tooth 7 changed", evidence="z = 13.0")
    rows = {row[0]: row for row in beside_rows(unknown, GearboxState(), [event])}
    assert rows["Friction level"][1:] == ("-", "", "NOT IDENTIFIABLE")
    assert rows["Power loss, measured"][1:] == ("-", "W", "")
    assert rows["Change"][3] == "sun tooth 7 changed: z = 13.0"
