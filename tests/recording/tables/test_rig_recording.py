"""A table from a test rig becomes a recording marked as measured, or is refused in one line."""

import json

import numpy as np
import pyarrow as pa
import pytest
from command_line import invoke, succeed
from pyarrow import csv, parquet
from twin_recording import decoded

import planetary_twin_py as pt
from planetary_twin_py.recording.runs.offline import NAMESPACE
from planetary_twin_py.recording.runs.schedule import read_runs
from planetary_twin_py.recording.tables.measurements import read_measurements

SOUND = {
    "time": [12.5, 12.6, 12.7],
    "input_speed [rpm]": [1000.0, 1002.0, 998.0],
    "input_torque [N m]": [60.0, 61.0, 62.0],
    "oil_temperature [°C]": [70.0, 70.0, 70.0],
    "power_loss [kW]": [0.0757, 0.0760, None],
    "sun_planet_dte_rms_2 [um]": [0.1, 0.2, 0.3],
}

SOUND_DATES = np.datetime64("2026-11-22T10:00:00", "ms") + 20 * np.arange(3).astype("m8[ms]")


def write(folder, columns, name="rig.csv"):
    path = folder / name
    (csv.write_csv if name.endswith("csv") else parquet.write_table)(pa.table(columns), path)
    return path


def bring_in(folder, columns, *more, name="rig.csv"):
    return invoke("import", write(folder, columns, name), "--out", folder / "rig", *more)


@pytest.mark.parametrize("name", ["rig.csv", "rig.parquet"])
def test_columns_become_fields_in_si_others_are_nan(tmp_path, name):
    done = bring_in(tmp_path, SOUND, name=name)
    assert done.exit_code == 0, done.output
    assert "3 rows, one every 0.1 s" in done.output
    states = decoded(tmp_path / "rig", f"{NAMESPACE}/gearbox_state")
    assert [s.sequence for s in states] == [1, 2, 3] and {s.planets for s in states} == {3}
    assert [s.simulated_time for s in states] == pytest.approx([0.1, 0.2, 0.3], rel=1e-12)
    assert [s.interval for s in states] == pytest.approx([0.1] * 3, rel=1e-12)
    assert [s.input_speed for s in states] == pytest.approx(
        [1000 * np.pi / 30, 1002 * np.pi / 30, 998 * np.pi / 30], rel=1e-12
    )
    assert [s.power_loss for s in states] == pytest.approx([75.7, 76.0, np.nan], nan_ok=True)
    rms = np.array([s.sun_planet_dte_rms for s in states])
    assert rms[:, 1] == pytest.approx([1e-7, 2e-7, 3e-7])
    assert np.isnan(np.delete(rms, 1, axis=1)).all()
    assert all(np.isnan([s.output_torque, s.tolerance, s.sun_angle]).all() for s in states)


def test_the_operating_point_is_the_mean_of_its_rows(
    tmp_path,
):
    bring_in(tmp_path, SOUND, "--set", "backlash=0.3um")
    (only,) = read_runs(tmp_path / "rig", NAMESPACE, [])
    (change,) = only.changes
    assert change.values["input_speed"] == pytest.approx(pt.rpm(1000.0))
    assert change.values["input_torque"] == pytest.approx(61.0)
    assert change.values["oil_temperature"] == pytest.approx(343.15)
    assert change.values["backlash"] == 3e-7
    assert only.origin.scene.live_values == change.values


def test_rows_with_another_label_are_another_operating_point(tmp_path):
    columns = {
        "time": np.arange(6) / 100.0,
        "operating_point": ["low", "low", "high", "high", "high", "low"],
        "input_torque": [20.0, 20.2, 60.0, 61.0, 59.0, 20.1],
        "power_loss": np.full(6, 30.0),
    }
    done = bring_in(tmp_path, columns)
    assert done.exit_code == 0, done.output
    (only,) = read_runs(tmp_path / "rig", NAMESPACE, [])
    assert [c.time for c in only.changes] == pytest.approx([0.0, 0.02, 0.05])
    assert [c.values["input_torque"] for c in only.changes] == pytest.approx([20.1, 60.0, 20.1])
    assert "from 0.02 s: input_torque = 60 N m" in done.output


def test_time_stamps_may_be_calendar_dates(tmp_path):
    stamps = np.datetime64("2026-11-22T10:00:00", "ms") + 20 * np.arange(4).astype("m8[ms]")
    done = bring_in(tmp_path, {"time": stamps, "power_loss": np.ones(4)})
    assert done.exit_code == 0 and "4 rows, one every 0.02 s" in done.output, done.output


@pytest.mark.parametrize(
    "text",
    [
        "time;power_loss [kW];operating_point\n1;0;warm, loaded\n1,5;0,25;warm, loaded\n",
        "time;power_loss [kW]\n1;0\n1.5;0.25\n",
        "time\tpower_loss [kW]\n1\t0\n1,5\t0,25\n",
    ],
)
def test_semicolons_tabulators_and_decimal_commas_are_read(tmp_path, text):
    (tmp_path / "rig.csv").write_text(text)
    measured = read_measurements(tmp_path / "rig.csv", {"power_loss": "W"})
    assert measured.step == 0.5
    assert measured.columns["power_loss"] == pytest.approx([0.0, 250.0])


def test_verify_reports_a_measurement_and_does_not_compare(tmp_path):
    bring_in(tmp_path, SOUND)
    done = invoke("verify", tmp_path / "rig", "--json", tmp_path / "out.json")
    assert done.exit_code == 2 and done.output.count("\n") == 1
    assert "was measured (imported from rig.csv), not simulated" in done.output
    assert not (tmp_path / "out.json").exists()


def test_a_simulation_based_on_it_is_marked_as_a_simulation(tmp_path):
    bring_in(tmp_path, SOUND)
    done = succeed("resimulate", tmp_path / "rig", "--from", 0.1, "--out", tmp_path / "twin")
    assert "was measured: the part before the branch is simulated, too" in done.output
    verdict = invoke("verify", tmp_path / "twin", "--json", "-")
    assert verdict.exit_code == 0 and json.loads(verdict.stdout)["identical"]


def test_one_file_instead_of_a_folder(tmp_path):
    table = write(tmp_path, SOUND)
    assert invoke("import", table, "--out", tmp_path / "rig.mcap").exit_code == 0
    assert read_runs(tmp_path / "rig.mcap", NAMESPACE, [])
    again = invoke("import", table, "--out", tmp_path / "rig.mcap")
    assert again.exit_code == 2 and "rig.mcap': already exists" in again.output


def with_column(name, values, **without):
    return {**{k: v for k, v in SOUND.items() if k not in without}, name: values}


def with_time(*time):
    return with_column("time", list(time))


@pytest.mark.parametrize(
    ("columns", "reason"),
    [
        (with_time(1.0, 1.1, 1.05), "row 3: time = 1.05 s: must be later than 1.1 s"),
        (with_time(1.0, 1.1, None), "row 3: time = nan s: must be"),
        (with_time(0.0, 120.0, 240.0), "a row every 120 s: must be at most 60 s"),
        (with_column("power_los", [1, 2, 3]), "no such quantity; did you mean power_loss?"),
        (with_column("line\nbreak", [1, 2, 3]), r"column 'line\nbreak': no such"),
        (with_column("power_loss", [1, 2, 3]), "column 'power_loss': power_loss is given twice"),
        (with_column("efficiency", ["a", "b", "c"]), "row 1: efficiency = 'a': must be a number"),
        (
            with_column("output_speed [1/min]", [1, 2, 3]),
            "'output_speed': [1/min] cannot be converted",
        ),
        (with_column("output_speed [m]", [1, 2, 3]), "[m] cannot be converted to rad/s"),
        (
            with_column("torque_ripple", [1, None, 1]),
            "row 2: torque_ripple = nan: must be a number",
        ),
        (with_column("lambda_ratio", [11, 11, 11]), "lambda_ratio = 11.0: must be a number within"),
        (with_column("backlash", [1e-7, 1e-7, 2e-7]), "rows 1 to 3: backlash varies from 1e-07 to"),
        (
            with_column("backlash [kg]", [1, 1, 1]),
            "column 'backlash': [kg] cannot be converted to",
        ),
        ({"power_loss": [1.0, 2.0]}, "column 'time': missing"),
        ({"time": [1.0, 2.0]}, "has no value besides the time"),
        ({"time": [1.0], "power_loss": [1.0]}, "1 rows: must be at least 2"),
    ],
)
def test_an_invalid_table_is_refused_in_one_line(tmp_path, columns, reason):
    done = bring_in(tmp_path, columns)
    assert done.exit_code == 2, done.output
    assert reason in done.output and done.output.count("\n") == 1
    assert done.output.startswith(f"planetary-twin: {tmp_path}/")
    assert not (tmp_path / "rig").exists()


def test_a_missing_row_is_reported_with_its_position(tmp_path):
    time = np.delete(np.arange(100) / 100.0, 40)
    done = bring_in(tmp_path, {"time": time, "power_loss": np.ones(99)})
    assert done.exit_code == 2
    assert "row 41: time = 0.41 s: is 0.02 s after the previous row, must be 0.01 s" in done.output


def test_a_file_that_is_no_table_is_refused(tmp_path):
    (tmp_path / "rig.xlsx").write_text("time\n")
    (tmp_path / "truncated.parquet").write_bytes(b"PAR1")
    (tmp_path / "latin.csv").write_bytes(
        "time,oil_temperature [°C]\n1,60\n2,60\n".encode("latin-1")
    )
    for name, reason in (
        ("rig.xlsx", "must end in"),
        ("truncated.parquet", "truncated.parquet"),
        ("no.csv", "no.csv: No such file"),
        ("latin.csv", "latin.csv: must be in UTF-8"),
    ):
        done = invoke("import", tmp_path / name, "--out", tmp_path / "rig")
        assert done.exit_code == 2 and reason in done.output and done.output.count("\n") == 1


RIG = {
    "time": np.arange(1, 9) / 10.0,
    "input_torque": np.full(8, 63.0),
    "input_speed [rpm]": np.full(8, 1000.0),
}
POWER = 63.0 * 1000.0 * np.pi / 30.0  # [W]


@pytest.mark.parametrize(
    ("column", "said"),
    [
        ({"power_loss": [*[75.0] * 5, 8000.0, 75.0, 75.0]},
         f"row 6: power_loss = 8000 W: must be below the input power, {POWER:.6g} W"),
        ({"power_loss": np.full(8, -75.0)},
         "row 1: power_loss = -75 W: must not be negative on average"),
        ({"efficiency": [0.99, 0.99, -0.2, *[0.99] * 5]},
         "row 3: efficiency = -0.2: must be at least 0"),
        ({"efficiency": np.full(8, 98.9)}, "must be efficiency [%]"),
        ({"power_loss": np.full(8, 75.0), "input_power": np.full(8, 60.0)},
         "row 1: power_loss = 75 W: must be below the input power, 60 W"),
    ],
)  # fmt: skip
def test_a_loss_that_no_gearbox_has_is_refused_with_its_row(tmp_path, column, said):
    done = bring_in(tmp_path, RIG | column)
    assert done.exit_code == 2 and said in " ".join(done.output.split()), done.output
    assert not (tmp_path / "rig").exists()


def test_losses_that_noise_makes_negative_are_accepted(tmp_path):
    """Ten watts with a standard deviation of thirty, and an efficiency of 1 within its noise."""
    noise = np.array([1.0, -1.0, 0.5, -0.5, 1.5, -1.5, 0.2, -0.2])
    columns = {"power_loss": 10.0 + 30.0 * noise, "efficiency": 1.001 + 0.01 * noise}
    assert bring_in(tmp_path, RIG | columns).exit_code == 0


def test_an_output_that_drives_may_lose_more_than_the_input(tmp_path):
    columns = {"input_torque": np.full(8, -0.1), "power_loss": np.full(8, 75.0)}
    assert bring_in(tmp_path, RIG | columns).exit_code == 0
