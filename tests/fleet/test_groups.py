"""A table of a fleet is followed in groups, here or by a cluster of which a worker is killed."""

import csv
import json

import numpy as np
import pytest
from command_line import run_here as run
from fleet.fleets import Played, paper
from studies.test_cluster import scheduler, until  # noqa: F401 - a fixture

from planetary_twin_py.fleet.groups import FollowGroup, follow_groups
from planetary_twin_py.fleet.tables import gearboxes_of
from planetary_twin_py.simulation.threads import Threads

ROWS, COUNT = 60, 12


@pytest.fixture(scope="module")
def table(tmp_path_factory):
    """Readings of twelve gearboxes, in minutes and with speeds in rpm; one has a gap."""
    path = tmp_path_factory.mktemp("fleet") / "scada.csv"
    played = Played(COUNT, 1, period=10.0)
    with path.open("w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(
            ["gearbox", "time", "input_torque", "output_torque", "input_speed [rpm]",
             "oil_temperature [degC]"]
        )  # fmt: skip
        for number in range(1, ROWS + 1):
            row = played.row(10.0 * number)
            for n in range(COUNT):
                if n == 3 and 20 < number < 30:
                    continue
                rows.writerow(
                    [f"G{n:02d}", 10.0 * number, row["input_torque"][n], row["output_torque"][n],
                     row["input_speed"][n] * 30.0 / np.pi, row["oil_temperature"][n] - 273.15]
                )  # fmt: skip
    return path


def test_groups_give_the_same_bits_as_one(table):
    work = FollowGroup(table, paper(), COUNT)
    names = gearboxes_of(table)
    whole = follow_groups(work, names, Threads(1))
    assert repr(follow_groups(work, names, Threads(2), size=5)) == repr(whole)  # NaN, too
    assert [one.gearbox for one in whole] == list(names)
    assert whole[3].readings == ROWS - 9 and whole[4].readings == ROWS


def test_a_group_that_cannot_be_read_is_named(table, tmp_path):
    work = FollowGroup(tmp_path / "none.csv", paper(), COUNT)
    with pytest.raises(ValueError, match="gearboxes G00 to G11"):
        follow_groups(work, gearboxes_of(table), Threads(1))


def test_the_command_names_what_is_wrong_in_valid_json(table, tmp_path):
    lines = table.read_text().splitlines()
    wrong, state = tmp_path / "wrong.csv", tmp_path / "state.json"
    with wrong.open("w") as file:
        for line in lines:
            cells = line.split(",")
            if cells[0] == "G05":
                cells[4] = str(-float(cells[4]))
            file.write(",".join(cells) + "\n")
    said = run("fleet", "paper", "--from", wrong, "--out", tmp_path / "state.csv", "--json", state)
    assert "G05: readings contradict the scene, not estimated: loss torque" in said.stdout
    assert "G03: at 9 times of the table, the first at 210 s" in said.stderr

    def refuse(constant):
        raise AssertionError(constant)

    figures = json.loads(state.read_text(), parse_constant=refuse)
    assert figures["G05"]["fault"].startswith("loss torque") and not figures["G05"]["fits"]
    assert figures["G05"]["estimates"]["friction_level"] == [None, None, None]
    assert figures["G03"]["missing"] == 9 and figures["G04"]["fault"] is None
    with (tmp_path / "state.csv").open() as file:
        rows = {row["gearbox"]: row for row in csv.DictReader(file)}
    assert rows["G05"]["fault"].startswith("loss torque") and rows["G03"]["missing"] == "9"


@pytest.mark.parametrize(
    ("output_torque", "line"),
    [("-145.0", "readings contradict the scene"), ("", "a torque or the speed is missing")],
)
def test_a_fleet_of_which_none_is_judged_is_bad_data(tmp_path, output_torque, line):
    path, state = tmp_path / "scada.csv", tmp_path / "state.csv"
    rows = (f"A,{second},63.0,{output_torque},104.72\n" for second in range(1, 31))
    path.write_text("gearbox,time,input_torque,output_torque,input_speed\n" + "".join(rows))
    said = run("fleet", "paper", "--from", path, "--out", state)
    assert said.returncode == 2
    assert "none judged" in said.stdout and line in said.stdout + said.stderr
    assert "no gearbox is judged" in said.stderr.splitlines()[-1]
    assert state.exists()
