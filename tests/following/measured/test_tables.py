"""Tables of readings: what is read twice, too large or not at all is refused."""

import re

import numpy as np
import pyarrow as pa
import pytest
from pyarrow import parquet
from scipy.io import savemat

from planetary_twin_py.fleet.tables import read_fleet
from planetary_twin_py.following.channels.encoders import read_encoders
from planetary_twin_py.following.channels.vibration import read_vibration
from planetary_twin_py.following.measured.tables import read_readings
from planetary_twin_py.following.sensors import read_sensors
from planetary_twin_py.plant.hidden import read_hidden
from planetary_twin_py.recording.tables.measurements import read_measurements
from planetary_twin_py.scene import SceneError

HEADING = "gearbox,time,input_torque,output_torque,input_speed"
SIX = "A,0,60,-140,100,60"


@pytest.fixture
def write(tmp_path):
    def table(*lines, name="rig.csv"):
        file = tmp_path / name
        file.write_text("\n".join(lines) + "\n")
        return file

    return table


@pytest.mark.parametrize("twice", ["input_torque", "input_torque [kN m]"])
def test_a_channel_is_given_once_in_one_unit(write, twice):
    table = write(f"{HEADING},{twice}", SIX)
    with pytest.raises(ValueError, match=r"column 'input_torque.*': input_torque is given twice"):
        read_readings(table, {})
    with pytest.raises(ValueError, match="input_torque is given twice"):
        read_fleet(table, ("A",))
    named = write("time,input_torque,T1", "0,1,2")
    with pytest.raises(ValueError, match="column 'T1': input_torque is given twice"):
        read_readings(named, {"input_torque": "T1"})


def test_a_table_without_a_reading_is_refused(write):
    for rows in ((), ("A,0,,,", "A,1,nan,nan,nan"), ("A,,60,-140,100",)):
        with pytest.raises(ValueError, match="has no row with a time and a reading"):
            read_readings(write(HEADING, *rows), {})


@pytest.mark.parametrize("read", [read_sensors, read_hidden])
def test_errors_of_sensors_and_of_what_is_hidden_name_the_file(write, read):
    with pytest.raises(SceneError, match=r"a\.yaml: the file has 2 errors:\n  b: no such field"):
        read(write("b: 1", "c: 2", name="a.yaml"))
    with pytest.raises(SceneError, match=r"a\.yaml: b: given twice, in line 1$"):
        read(write("{b: 1, b: 2}", name="a.yaml"))
    file = write(name="a.yaml")
    file.write_bytes(b"\xff")
    with pytest.raises(SceneError, match=r"a\.yaml: must be in UTF-8, byte 1 is not"):
        read(file)


def test_a_mat_file_has_the_readings_of_the_same_csv_table(write, tmp_path):
    table = write("time,input_torque,input_speed", "0.1,60,100", "0.2,61,101")
    columns = {"time": [0.1, 0.2], "input_torque": [60.0, 61.0], "input_speed": [100, 101]}
    savemat(tmp_path / "rig.mat", columns | {"notes": "rig 3", "rate": 10.0, "map": np.eye(3)})
    one, other = (read_readings(file, {}) for file in (table, tmp_path / "rig.mat"))
    assert repr(one) == repr(other)


@pytest.mark.parametrize(
    ("contents", "message"),
    [
        ({"time": [0.0, 1.0], "input_torque": [1.0, 2.0, 3.0]}, "must be a vector as long as time"),
        (
            {"time": [0.0, 1.0], "input_torque": [1j, 2.0]},
            "input_torque: must be a vector of real numbers",
        ),
        ({"notes": "rig 3"}, "has no vector of numbers"),
    ],
)
def test_a_mat_file_without_columns_of_one_length_is_refused(tmp_path, contents, message):
    savemat(tmp_path / "rig.mat", contents)
    with pytest.raises(ValueError, match=rf"rig\.mat: .*{message}"):
        read_readings(tmp_path / "rig.mat", {})


def test_vibration_is_every_column_that_is_no_reading(write):
    heading = "time,T1,input_speed,sample,input_counts,output_counts,housing [g],bearing"
    found = read_vibration(write(heading, "0,60,100,0,1,2,0.5,3", "0.001,60,100,1,2,3,0.6,4"),
                           {"input_torque": "T1"})  # fmt: skip
    assert found.names == ("housing [g]", "bearing")
    assert found.period == 0.001
    np.testing.assert_array_equal(found.values, [[0.5, 3.0], [0.6, 4.0]])


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        (("housing", "1", "2"), "column 'time': missing"),
        (("time,input_speed", "0,1", "0.001,1"), "has no column of vibration"),
        (("time,housing", "0,1"), "median step is 0 s: must be within 0 and 1 s"),
        (("time,housing", "0,1", "5,1"), "median step is 5 s: must be within 0 and 1 s"),
        (("time,housing", "0,a", "0.001,1"), "row 1: housing = 'a': must be a number"),
    ],
)
def test_a_table_that_is_no_vibration_is_refused(write, lines, message):
    with pytest.raises(ValueError, match=message) as error:
        read_vibration(table := write(*lines), {})
    assert str(error.value).startswith(f"{table}: ")


def test_dates_of_several_tables_count_from_the_same_second(tmp_path):
    noon = np.datetime64("2026-11-24T12:00:00", "ns")

    def table(name, delay, **columns):
        step = np.timedelta64(50, "us")
        dates = noon + np.timedelta64(delay, "ms") + step * np.arange(2)
        parquet.write_table(pa.table({"time": dates} | columns), tmp_path / name)
        return tmp_path / name

    begin = read_readings(table("rig.parquet", 0, input_torque=[60.0, 61.0]), {}).begin
    counts = {"input_counts": [1, 2], "output_counts": [3, 4]}
    encoders = table("encoders.parquet", 1500, **counts)
    vibration = table("vibration.parquet", 2500, housing=[0.1, 0.2])
    assert list(read_encoders(encoders, 5e-5, begin).sample) == [30_000, 30_001]
    np.testing.assert_allclose(read_vibration(vibration, {}, begin).time, [2.5, 2.50005])
    for read in (lambda: read_encoders(encoders, 5e-5), lambda: read_vibration(vibration, {})):
        with pytest.raises(ValueError, match="time: has dates, but the readings have seconds"):
            read()


ROWS = [f"{n / 100},{60 + n},{-140 - n},100" for n in range(1, 300)]
COLUMNS = "time,input_torque,output_torque,input_speed"


def shuffled(rows):
    return [rows[n] for n in np.random.default_rng(0).permutation(len(rows))]


def test_rows_in_any_order_give_readings_of_the_rows_in_order(write):
    one = read_readings(write(COLUMNS, *ROWS, name="a.csv"), {})
    other = read_readings(write(COLUMNS, *shuffled(ROWS), name="b.csv"), {})
    assert one.readings.time.tobytes() == other.readings.time.tobytes()
    for name, values in one.readings.columns.items():
        assert values.tobytes() == other.readings.columns[name].tobytes()


@pytest.mark.parametrize(
    ("headings", "lacking"),
    [
        ("time,input_torque,T2,input_speed", ["output_torque"]),
        ("time,input_torque,output_torque,speed", ["input_speed or output_speed"]),
        (COLUMNS, []),
    ],
)
def test_columns_that_losses_lack_are_named(write, headings, lacking):
    remarks = read_readings(write(headings, *ROWS), {}).remarks
    assert len(remarks) == len(lacking)
    for line, name in zip(remarks, lacking, strict=True):
        assert f"no column {name} with readings: losses are not estimated" in line


READERS = [
    lambda table: read_readings(table, {}),
    lambda table: read_fleet(table, ("A",)),
    lambda table: read_measurements(table, {"input_torque": "N m"}),
]


@pytest.mark.parametrize("read", READERS)
def test_a_time_that_is_no_date_is_refused_with_an_example(write, read):
    time = "22.11.2026 10:00:00"
    wanted = (
        f"row 1: time = '{time}': must be a number of seconds, or a date such as "
        "2026-11-22 10:00:00"
    )
    rows = [f"A,{time},60,-140,100", f"A,{time},60,-140,100"]
    table = write(HEADING, *rows)
    if read is READERS[2]:
        table = write("time,input_torque", f"{time},60", f"{time},60")
    with pytest.raises(ValueError, match=re.escape(wanted)):
        read(table)


def test_day_numbers_of_a_spreadsheet_are_named(write):
    days = [f"{46348.0 + second / 86_400.0!r}" for second in range(4)]
    advice = r"steps of 1\.16e-05 s: are these day numbers .* such as 2026-11-22 10:00:00"
    table = write(HEADING, *[f"A,{day},60,-140,100" for day in days])
    (line,) = read_readings(table, {}).remarks
    assert re.search(advice, line)
    with pytest.raises(ValueError, match=advice):
        read_fleet(table, ("A",))
    rig = write("time,input_torque", *[f"{day},60" for day in days], name="import.csv")
    with pytest.raises(ValueError, match=advice):
        read_measurements(rig, {"input_torque": "N m"})


@pytest.mark.parametrize(
    ("heading", "said"),
    [
        ("gearbox,Stamp,input_torque", "column 'time': missing; has gearbox, Stamp, input_torque"),
        (
            "gearbox,time,Input Torque,Output-Torque,n",
            "column 'input_torque': missing; rename Input Torque to input_torque",
        ),
    ],
)
def test_a_missing_column_is_named_beside_those_that_there_are(write, heading, said):
    table = write(heading, ",".join(["1"] * len(heading.split(","))))
    with pytest.raises(ValueError, match=said):
        read_fleet(table, ("1",))
