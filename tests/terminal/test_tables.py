"""Tables at any terminal width contain every word and every number, uncut."""

import io

import pytest
from command_line import succeed
from rich.table import Table
from tiers import first

from planetary_twin_py.terminal.tables import TableConsole

WIDTHS = (60, 80, 100)
SAMPLE = "recordings/sample"


def shown(command, width):
    done = succeed(*command, COLUMNS=str(width))
    return done.stdout


def words(text):
    """The words of a table, regardless of lines, columns and borders."""
    inside = "".join(character if character < "\u2500" else " " for character in text)
    return set(inside.replace(";", " ").replace(":", " ").split())


@pytest.mark.parametrize("width", first(1, WIDTHS))
@pytest.mark.parametrize(
    "command",
    [
        ["modal", "paper"],
        ["modal", "wind_turbine_stage", "--model", "planar"],
        ["modal", "wind_turbine_stage", "--model", "spatial"],
        ["fields", "mesh"],
        ["info", SAMPLE],
        ["spectrum", SAMPLE],
    ],
    ids=" ".join,
)
def test_a_narrow_terminal_shows_the_same_words_as_a_wide_one(command, width):
    narrow = shown(command, width)
    assert "\u2026" not in narrow
    # The heading of the first column is omitted if rows become paragraphs.
    assert words(shown(command, 1000)) - {"name", "topic"} == words(narrow) - {"name", "topic"}
    tables = [line for line in narrow.splitlines() if "\u2500" <= line[:1] < "\u2600"]
    assert max(map(len, tables), default=0) <= width


def printed(width, **column):
    table = Table(title="Names", caption="of two")
    table.add_column("name", **column)
    table.add_column("value", justify="right")
    table.add_column("remark")
    table.add_row("drive.input.coupling_stiffness", "1.23456e-05", "as long as it has to be")
    table.add_row("backlash", "3e-07", "")
    console = TableConsole(file=io.StringIO(), width=width)
    console.print(table)
    return console.file.getvalue()


def test_a_column_wraps_only_between_words():
    lines = printed(60).splitlines()
    assert max(map(len, lines)) <= 60
    (row,) = [line for line in lines if "coupling_stiffness" in line]
    assert "drive.input.coupling_stiffness" in row and "1.23456e-05" in row


def test_a_table_too_wide_for_its_words_is_printed_row_by_row():
    lines = [line.rstrip() for line in printed(50).splitlines()]
    assert lines == [
        "Names",
        "drive.input.coupling_stiffness",
        "    value: 1.23456e-05; remark: as long as it has",
        "    to be",
        "backlash",
        "    value: 3e-07",
        "of two",
    ]
