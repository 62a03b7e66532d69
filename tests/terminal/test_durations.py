"""Times on the command line are in seconds, or have a unit."""

import pytest
import typer
from typer.testing import CliRunner

from planetary_twin_py.cli import build_app
from planetary_twin_py.terminal.durations import read_seconds


@pytest.mark.parametrize(
    ("given", "seconds"),
    [("10ms", 0.01), ("5 us", 5e-6), ("2 min", 120.0), ("0.2", 0.2), (0.2, 0.2), ("1e-2", 0.01)],
)
def test_a_time_is_read_in_seconds(given, seconds):
    assert read_seconds(given) == pytest.approx(seconds, rel=1e-12)


@pytest.mark.parametrize("given", ["10 m", "soon", "1,5", "", "3 rpm"])
def test_text_that_is_not_a_time_is_refused(given):
    with pytest.raises(typer.BadParameter, match="must be a number of seconds, or with a unit"):
        read_seconds(given)


def test_the_duration_of_a_run_follows_the_unit(tmp_path):
    out = tmp_path / "run.csv"
    command = ["simulate", "--duration", "2ms", "--sample-rate", "10000", "--out", str(out)]
    done = CliRunner().invoke(build_app(), command)
    assert done.exit_code == 0, done.output
    assert len(out.read_text().splitlines()) == 1 + 20


def test_a_wrong_unit_names_the_option():
    done = CliRunner().invoke(build_app(), ["simulate", "--duration", "2 m"])
    assert done.exit_code == 2 and "--duration" in done.output and "10ms" in done.output
