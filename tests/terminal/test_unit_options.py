"""Times and frequencies on the command line are in SI, or have a unit."""

import pytest
import typer
from command_line import invoke

from planetary_twin_py.terminal.unit_options import read_hertz, read_seconds


@pytest.mark.parametrize(
    ("read", "given", "value"),
    [
        *((read_seconds, "10ms", 0.01), (read_seconds, "5 us", 5e-6), (read_seconds, "2 min", 120)),
        *((read_seconds, "0.2", 0.2), (read_seconds, 0.2, 0.2), (read_seconds, "1e-2", 0.01)),
        *((read_hertz, "50kHz", 5e4), (read_hertz, "1 MHz", 1e6), (read_hertz, "2e4", 2e4)),
        (read_hertz, 100.0, 100.0),
    ],
)
def test_times_and_frequencies_are_read_in_si(read, given, value):
    assert read(given) == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize(
    ("read", "unit", "texts"),
    [
        (read_seconds, "seconds", ("10 m", "soon", "1,5", "", "3 rpm")),
        (read_hertz, "hertz", ("10 m", "often", "50 ms", "")),
    ],
)
def test_other_texts_are_refused(read, unit, texts):
    for text in texts:
        with pytest.raises(typer.BadParameter, match=f"must be a number of {unit}, or with a unit"):
            read(text)


@pytest.mark.parametrize(
    ("option", "given", "example"),
    [("--duration", "2 m", "10ms"), ("--sample-rate", "2 ms", "50kHz")],
)
def test_a_wrong_unit_names_the_option(option, given, example):
    done = invoke("simulate", option, given)
    assert done.exit_code == 2 and option in done.output and example in done.output
