"""Times and frequencies on the command line are in SI, or have a unit."""

import pytest
import typer
from command_line import invoke

from planetary_twin_py.terminal.unit_options import read_hertz, read_seconds


@pytest.mark.parametrize(
    ("given", "seconds"),
    [("10ms", 0.01), ("5 us", 5e-6), ("2 min", 120.0), ("0.2", 0.2), (0.2, 0.2), ("1e-2", 0.01)],
)
def test_a_time_is_read_in_seconds(given, seconds):
    assert read_seconds(given) == pytest.approx(seconds, rel=1e-12)


@pytest.mark.parametrize(
    ("given", "hertz"), [("50kHz", 5e4), ("1 MHz", 1e6), ("2e4", 2e4), (100.0, 100.0)]
)
def test_a_frequency_is_read_in_hertz(given, hertz):
    assert read_hertz(given) == pytest.approx(hertz, rel=1e-12)


@pytest.mark.parametrize("given", ["10 m", "soon", "1,5", "", "3 rpm"])
def test_text_that_is_not_a_time_is_refused(given):
    with pytest.raises(typer.BadParameter, match="must be a number of seconds, or with a unit"):
        read_seconds(given)


@pytest.mark.parametrize("given", ["10 m", "often", "50 ms", ""])
def test_text_that_is_not_a_frequency_is_refused(given):
    with pytest.raises(typer.BadParameter, match="must be a number of hertz, or with a unit"):
        read_hertz(given)


def test_duration_and_rate_of_a_run_follow_their_units(tmp_path):
    out = tmp_path / "run.csv"
    command = ["simulate", "--duration", "2ms", "--sample-rate", "10kHz", "--out", str(out)]
    done = invoke(*command)
    assert done.exit_code == 0, done.output
    assert len(out.read_text().splitlines()) == 1 + 20


@pytest.mark.parametrize(
    ("option", "given", "example"),
    [("--duration", "2 m", "10ms"), ("--sample-rate", "2 ms", "50kHz")],
)
def test_a_wrong_unit_names_the_option(option, given, example):
    done = invoke("simulate", option, given)
    assert done.exit_code == 2 and option in done.output and example in done.output
