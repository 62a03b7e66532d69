"""A program that has read a table ends as it should."""

import subprocess
import sys

import pyarrow as pa
import pyarrow.parquet
import pytest

PROGRAM = """
import sys
from pathlib import Path
from planetary_twin_py.recording.tables.measurements import read_columns
columns = read_columns(Path(sys.argv[1]))
sys.exit(len(columns))
"""


@pytest.mark.release
@pytest.mark.parametrize(
    "suffix, comment", [(".csv", ""), (".csv", "# comment\n"), (".parquet", "")]
)
def test_threads_that_read_a_table_never_abort_the_end(tmp_path, suffix, comment):
    path = tmp_path / f"table{suffix}"
    if suffix == ".csv":
        path.write_text(
            comment + "time,a,b\n" + "".join(f"{0.001 * k},{k},{-k}\n" for k in range(5))
        )
    else:
        pyarrow.parquet.write_table(
            pa.table({name: [1.0, 2.0] for name in ("time", "a", "b")}), path
        )
    command = [sys.executable, "-c", PROGRAM, path]
    ends = [subprocess.run(command, capture_output=True).returncode for _ in range(30)]
    assert set(ends) == {3}  # columns
