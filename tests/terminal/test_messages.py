"""Error messages of the command line."""

import pytest
import typer

from planetary_twin_py.terminal.messages import fail


@pytest.mark.parametrize(
    ("error", "line"),
    [
        (ValueError("field = 1: must be 2"), "field = 1: must be 2"),
        (OSError(5, "Input/output error", "a.mcap"), "a.mcap: Input/output error"),
        (OSError(5, "Input/output error"), "Input/output error"),  # from a read
        (OSError("no reason of the system"), "no reason of the system"),
    ],
)
def test_an_error_is_one_line_without_the_names_of_python(capsys, error, line):
    with pytest.raises(typer.Exit):
        fail(error)
    assert capsys.readouterr().err == f"planetary-twin: {line}\n"
