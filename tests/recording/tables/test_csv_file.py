"""CSV as loggers write it: what is no value is left out, what is wrong is named with its row."""

import numpy as np
import pytest

from planetary_twin_py.recording.tables.measurements import read_columns

ROWS = ["time [s],acceleration [m/s^2]", "0,1.5", "0.1,-2", "0.2,0.25"]
VALUES = {"time": [0.0, 0.1, 0.2], "acceleration": [1.5, -2.0, 0.25]}


def read(tmp_path, text):
    file = tmp_path / "table.csv"
    file.write_bytes(text.encode())
    return {name: column.as_given(name).tolist() for name, column in read_columns(file).items()}


@pytest.mark.parametrize("end", ["\n", "\r\n"])
@pytest.mark.parametrize(
    "lines",
    [
        ROWS,
        ["# recorder 7, rig 2", "# 2025-10-26", *ROWS],
        ["% recorder 7", "", *ROWS],
        ["// recorder 7", *ROWS[:2], "# paused", *ROWS[2:], "# end"],
        [f"# {ROWS[0]}", *ROWS[1:]],
        ["# recorder 7", f"# {ROWS[0]}", *ROWS[1:]],
        [f"{row}," for row in ROWS],
        [ROWS[0], *(f"{row}," for row in ROWS[1:])],
        [f"{ROWS[0]},", *ROWS[1:]],
        [row.replace(",", ";") + ";" for row in ROWS],
    ],
    ids=lambda lines: " | ".join(lines[:3]),
)
def test_comments_and_an_empty_last_column_are_no_values(tmp_path, lines, end):
    assert read(tmp_path, end.join((*lines, ""))) == VALUES


def test_a_heading_that_numpy_writes_as_a_comment_is_read(tmp_path):
    file = tmp_path / "table.csv"
    np.savetxt(file, np.column_stack([*VALUES.values()]), delimiter=",", header=ROWS[0])
    assert read_columns(file).keys() == VALUES.keys()


def test_a_last_value_may_be_missing(tmp_path):
    found = read(tmp_path, "time,a\n0,\n1,2\n")
    assert found["time"] == [0.0, 1.0] and np.isnan(found["a"][0]) and found["a"][1] == 2.0


@pytest.mark.parametrize(
    ("lines", "reason"),
    [
        ([*ROWS, "End of data"], "row 4: has 1 value, must have 2: 'End of data'"),
        ([*ROWS[:3], "# pause", "0.2,3,4", "0.3"], "row 3: has 3 values, must have 2: '0.2,3,4'"),
        (["recorder 7,", *ROWS[1:], "0.3,4,5"], "row 4: has 3 values, must have 2: '0.3,4,5'"),
        (["0.0,1e-3", "0.1,2"], "row 1: must have the headings of the columns"),
        ([*ROWS, "0.3,-"], "row 4: acceleration = '-': must be a number"),
    ],
)
def test_what_is_no_row_is_named(tmp_path, lines, reason):
    with pytest.raises(ValueError) as refusal:
        read(tmp_path, "\n".join(lines))
    assert str(refusal.value).startswith(f"{tmp_path / 'table.csv'}: {reason}")


@pytest.mark.parametrize("name", ["table.xlsx", "table.uff", "table"])
def test_the_kinds_of_tables_are_named(tmp_path, name):
    with pytest.raises(ValueError, match=r"must end in \.csv, \.parquet, \.mat, .* or \.tdms"):
        read_columns(tmp_path / name)


def test_capital_letters_do_not_matter_in_a_suffix(tmp_path):
    (tmp_path / "TABLE.CSV").write_text("time,a\n0,1\n")
    assert list(read_columns(tmp_path / "TABLE.CSV")) == ["time", "a"]
