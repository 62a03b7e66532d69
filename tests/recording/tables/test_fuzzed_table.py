"""Random tables are imported, or refused in one line."""

import shutil

import numpy as np
import pyarrow as pa
import pytest
from fuzzing import check, searching
from hypothesis import given
from hypothesis import strategies as st
from pyarrow import parquet

import planetary_twin_py as pt
from planetary_twin_py.recording.tables.rig_recording import write_measured

pytestmark = [pytest.mark.exhaustive, pytest.mark.filterwarnings("ignore")]

ROWS = 6
SOUND = "time [s],input_speed [rpm],power_loss [kW],sun_planet_dte_mean_1 [um],operating_point\n"
SOUND += "".join(f"{0.1 * k:.1f},{1000 + k},0.{k},{k}e-1,a\n" for k in range(ROWS))
HEADINGS = st.one_of(
    st.sampled_from(
        [
            "time",
            "time [ms]",
            "simulated_time",
            "input_speed [rpm]",
            "input_torque [N m]",
            "planets",
        ]
    ),
    st.sampled_from(["oil_temperature [degC]", "operating_point", "stamp", "backlash [s]", ""]),
    st.sampled_from(
        ["power_loss [10**10**10 W]", "efficiency [%]", "output_torque [kip*ft/furlong]"]
    ),
    st.text(max_size=20),
    st.text("[]()*/-^ abmNsW0123456789.", max_size=20).map(lambda unit: f"power_loss [{unit}]"),
)
COLUMNS = st.one_of(
    st.just(list(np.arange(ROWS) * 0.1)),
    st.lists(st.floats(), min_size=ROWS, max_size=ROWS),
    st.lists(st.floats(0, 1e3), min_size=ROWS, max_size=ROWS),
    st.lists(st.none() | st.integers(-(2**63), 2**63 - 1), min_size=ROWS, max_size=ROWS),
    st.lists(st.none() | st.text(max_size=5), min_size=ROWS, max_size=ROWS),
    st.lists(st.none() | st.datetimes(), min_size=ROWS, max_size=ROWS),
    st.lists(st.none() | st.booleans(), min_size=ROWS, max_size=ROWS),
    st.lists(st.binary(max_size=4), min_size=ROWS, max_size=ROWS),
    st.lists(st.lists(st.floats(), max_size=2), min_size=ROWS, max_size=ROWS),
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("fuzzed")


def read(table):
    """Import `table`."""
    out = table.parent / "out"
    shutil.rmtree(out, ignore_errors=True)
    check(lambda: write_measured(table, pt.load_scene("paper"), out), ValueError)


@searching
@given(headings=st.lists(HEADINGS, min_size=1, max_size=4), data=st.data())
def test_a_table_with_other_columns_is_read_or_refused(folder, headings, data):
    columns = [pa.array(data.draw(COLUMNS)) for _ in headings]
    table = folder / "table.parquet"
    parquet.write_table(pa.Table.from_arrays(columns, names=headings), table)
    read(table)
