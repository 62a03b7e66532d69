"""Duties from tables: rows in SI, or one line that says what is wrong."""

import numpy as np
import pyarrow as pa
import pytest
from pyarrow import parquet

import planetary_twin_py as pt


def read(tmp_path, text, name="duty.csv"):
    path = tmp_path / name
    path.write_text(text)
    return pt.read_duty(path)


def test_a_series_holds_each_row_up_to_the_next(tmp_path):
    found = read(
        tmp_path,
        "time [min],torque [kN m],speed [rpm],oil_temperature [degC]\n"
        "0,1,1000,60\n10,2,900,61\n15,0,0,62\n",
    )
    np.testing.assert_allclose(found.held, [600.0, 300.0])
    np.testing.assert_allclose(found.columns["input_torque"], [1000.0, 2000.0])
    np.testing.assert_allclose(found.columns["input_speed"], pt.rpm(np.array([1000.0, 900.0])))
    np.testing.assert_allclose(found.columns["oil_temperature"], [333.15, 334.15])
    assert found.duration == 900.0 and not found.shares


def test_bins_have_a_duration_or_a_share(tmp_path):
    lasting = read(tmp_path, "duration [h],input_torque,input_speed\n1,10,100\n3,20,100\n")
    np.testing.assert_allclose(lasting.held, [3600.0, 10800.0])
    assert lasting.time is None and not lasting.shares
    shared = read(tmp_path, "share [percent],torque,speed,torque_std\n25,10,100,1\n75,20,100,2\n")
    np.testing.assert_allclose(shared.held, [0.25, 0.75])
    np.testing.assert_allclose(shared.columns["input_torque_std"], [1.0, 2.0])
    assert shared.shares


def test_parquet_is_read_with_the_units_of_its_headings(tmp_path):
    table = pa.table(
        {"share": [0.5, 0.5], "torque [kN m]": [1.0, 2.0], "speed [rpm]": [60.0, 60.0]}
    )
    parquet.write_table(table, tmp_path / "duty.parquet")
    found = pt.read_duty(tmp_path / "duty.parquet")
    np.testing.assert_allclose(found.columns["input_torque"], [1000.0, 2000.0])
    np.testing.assert_allclose(found.columns["input_speed"], 2.0 * np.pi)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("torque,speed\n1,1\n", "time, duration, share: has none of them"),
        ("time,share,torque,speed\n0,1,1,1\n1,1,1,1\n", "has time and share; must have one"),
        ("share,torque,speed\n0.5,1,1\n0.4,1,1\n", "adds up to 0.9, must be 1"),
        ("duration,torque,speed\n-1,1,1\n", "row 1: duration = -1: must be at least 0"),
        ("duration,torque\n1,1\n", "'input_speed': missing"),
        ("duration,torque,speed,backlash\n1,1,1,1\n", "'backlash': no such quantity"),
        ("duration,torque,speed,torque_std\n1,1,1,-1\n", "row 1: input_torque_std: must be at"),
        ("time,torque,speed\n0,1,1\n0,1,1\n", "row 2: time = 0 s: must increase"),
        ("duration,torque,speed\n1,,1\n", "row 1: input_torque is missing"),
        ("duration [m],torque,speed\n1,1,1\n", r"\[m\] cannot be converted to s"),
    ],
)
def test_what_is_ambiguous_or_missing_is_refused_in_one_line(tmp_path, text, reason):
    with pytest.raises(ValueError, match=reason) as refusal:
        read(tmp_path, text)
    assert "\n" not in str(refusal.value)


def test_an_outage_is_named(tmp_path):
    time = np.arange(40.0)
    time[30:] += 100.0
    rows = "".join(f"{t},1,1\n" for t in time)
    (line,) = read(tmp_path, f"time,torque,speed\n{rows}").remarks
    assert "row 30 with 101 s" in line
