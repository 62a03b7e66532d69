"""Error messages of the command line."""

import pytest
import typer

from planetary_twin_py import SceneError
from planetary_twin_py.terminal.messages import fail, naming_options


@pytest.mark.parametrize(
    ("error", "line"),
    [
        (ValueError("field = 1: must be 2"), "field = 1: must be 2"),
        (OSError(5, "Input/output error", "a.mcap"), "a.mcap: Input/output error"),
        (OSError(5, "Input/output error"), "Input/output error"),  # from a read
        (OSError("no reason of the system"), "no reason of the system"),
        (ValueError("[h:m:s] is no unit"), "[h:m:s] is no unit"),  # :m: would be a symbol
    ],
)
def test_an_error_is_one_line_without_the_names_of_python(capsys, error, line):
    with pytest.raises(typer.Exit):
        fail(error)
    assert capsys.readouterr().err == f"planetary-twin: {line}\n"


@pytest.mark.parametrize(
    ("error", "line"),
    [
        (ValueError("sample_rate = 0 Hz: must be 1"), "--sample-rate = 0 Hz: must be 1"),
        (ValueError("from = 1 s at sample_rate = 2 Hz"), "--from = 1 s at --sample-rate = 2 Hz"),
        (ValueError("mesh.from = 3, not_from = 4"), "mesh.from = 3, not_from = 4"),
        (ValueError("input_torque = 1e9 N m"), "input_torque = 1e9 N m"),  # of the scene
        (SceneError("a.yaml: from = 3"), "a.yaml: from = 3"),  # a field of the file
        ("from = 3", "from = 3"),  # a text of the command itself
    ],
)
def test_arguments_of_functions_are_shown_as_options(capsys, error, line):
    with naming_options(["--sample-rate", "--from"]), pytest.raises(typer.Exit):
        fail(error)
    assert capsys.readouterr().err == f"planetary-twin: {line}\n"
    with pytest.raises(typer.Exit):
        fail(error)
    assert capsys.readouterr().err == f"planetary-twin: {error}\n"
