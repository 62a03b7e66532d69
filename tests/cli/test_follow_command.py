"""`planetary-twin plant` and `planetary-twin follow`: from hidden truth to what is found of it."""

import csv
import json

import pytest
from command_line import run_here, succeed

HIDDEN = """
duty: {kind: reversing}
sensors:
  input_torque: {noise: 0.1 N m}
  output_torque: {noise: 0.25 N m}
  speed_noise: 0.02 rad/s
  encoders: {rate: 20 kHz, lost: 0.003}
changes:
  - {at: 15 s, friction: 1.3}
"""


def cli(*arguments):
    """What a command prints that succeeds."""
    done = succeed(*arguments, COLUMNS="200")
    return done.stdout


def fails(*arguments):
    """The one line of a command that fails."""
    done = run_here(*arguments)
    assert done.returncode == 2 and done.stderr.count("\n") == 1, done.stderr
    return done.stderr


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("follow")


@pytest.fixture(scope="module")
def readings(folder):
    (folder / "hidden.yaml").write_text(HIDDEN)
    table = folder / "readings.csv"
    cli("plant", "paper", "--hidden", folder / "hidden.yaml", "--duration", "30", "--out", table)
    return table


def test_a_step_of_friction_is_found(readings, folder):
    found, notes = folder / "found.json", folder / "notes.csv"
    text = cli("follow", "paper", "--from", readings, "--json", found, "--out", notes)
    assert "loss torque stepped" in text and "NOT IDENTIFIABLE" in text
    found = json.loads(found.read_text())
    (event,) = found["events"]
    assert 15.0 < event["found"] < 25.0
    assert found["estimates"]["friction_level"]["status"] == "ESTIMATED"
    assert found["counters"]["used"] > 14_000
    rows = list(csv.DictReader(notes.open()))
    assert len(rows) >= 29 and rows[-1]["events"] == "1"


def test_a_wrong_unit_is_named_and_mended(readings, folder):
    rows = list(csv.DictReader(readings.open()))
    wrong = folder / "wrong.csv"
    with wrong.open("w", newline="") as file:
        table = csv.DictWriter(file, [*rows[0]])
        table.writeheader()
        for row in rows:
            table.writerow(row | {"output_speed": float(row["output_speed"]) * 9.549297})
    message = fails("follow", "paper", "--from", wrong)
    assert "output_speed/input_speed = -4.09" in message
    assert "ESTIMATED" in cli("follow", "paper", "--from", wrong, "--scale", "output_speed=0.10472")


def test_vibration_in_the_table_of_readings_is_learned(readings, folder):
    rows = list(csv.reader(readings.open()))
    both = folder / "both.csv"
    with both.open("w", newline="") as file:
        csv.writer(file).writerows(
            [[*rows[0], "housing [g]"], *([*row, "0.1"] for row in rows[1:])]
        )
    picture = folder / "picture.svg"
    done = succeed(
        "follow", "paper", "--from", both, "--vibration", both, "--picture", picture, COLUMNS="200"
    )
    assert "columns that are not used" not in done.stderr
    assert "100 samples per second show lines up to" in done.stderr
    assert "loss torque stepped" in picture.read_text()
    assert (
        "columns that are not used: housing [g]"
        in run_here("follow", "paper", "--from", both).stderr
    )


def test_headings_may_be_others(readings, folder):
    text = readings.read_text().replace("input_torque", "T1 [Nm]", 1)
    other = folder / "other.csv"
    other.write_text(text)
    (folder / "columns.yaml").write_text("columns: {input_torque: T1}\n")
    assert "friction_level" in cli(
        "follow", "paper", "--from", other, "--sensors", folder / "columns.yaml"
    )


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--scale", "speed=2"], "scale: 'speed': must be one of input_speed"),
        (["--scale", "input_speed=fast"], "--scale input_speed = 'fast': must be a number"),
        (["--encoders", "missing.csv"], "missing.csv: No such file"),
        (["--sensors", "missing.yaml"], "missing.yaml: No such file"),
    ],
)
def test_arguments_are_checked(readings, arguments, message):
    assert message in fails("follow", "paper", "--from", readings, *arguments)


def test_a_table_without_readings_is_refused(folder):
    table = folder / "empty.csv"
    table.write_text("time,load\n0,1\n1,2\n")
    assert "has none of the columns input_speed" in fails("follow", "paper", "--from", table)


def test_without_output_torque_no_verdict_is_claimed(readings, folder):
    other = folder / "misnamed.csv"
    other.write_text(readings.read_text().replace("output_torque", "Torque out (Nm)", 1))
    done = succeed("follow", "paper", "--from", other, COLUMNS="200")
    assert "no change found" not in done.stdout and "changes cannot be found" in done.stdout
    assert "no column output_torque with readings: losses are not estimated" in done.stderr
    assert "columns that are not used: Torque out (Nm)" in done.stderr
