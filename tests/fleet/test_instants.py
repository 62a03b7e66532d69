"""Instants of a wandering speed scatter more than the sensors explain, and are named."""

import csv

import numpy as np
import pytest
from command_line import run_here
from fleet.fleets import Played
from fleet.instants import Wandering
from tiers import first_rows

from planetary_twin_py.fleet.fleet import Fleet
from planetary_twin_py.fleet.scatter import BALANCES, RARE
from planetary_twin_py.fleet.tables import read_fleet


def followed(played, period, duration, mean=False):
    fleet = Fleet(played.scene, played.count, period)
    for time, row in played.rows(period, duration, mean):
        fleet.add(time, row)
    fleet.finish()
    return fleet


@pytest.mark.parametrize(
    ("period", "wander"), first_rows(1, [(10.0, 0.003), (10.0, 0.01), (1.0, 0.003), (1.0, 0.01)])
)
def test_instants_give_no_false_alarm_and_intervals_that_hold(period, wander):
    played = Wandering(30, 1, wander)
    fleet = followed(played, period, 3600.0)
    assert fleet.scatter.excessive.all() and not fleet.events
    level = fleet.estimate("friction_level")
    known = np.isfinite(level.value)
    inside = (level.low < played.friction) & (played.friction < level.high)
    assert inside[known].sum() >= 0.9 * known.sum()
    # Too few rows within the memory of an hour determine the friction level of some.
    assert known.all() or period == 10.0 or wander == 0.01


def test_means_over_much_longer_than_wander_have_stated_scatter():
    played = Wandering(10, 2, 0.001)
    scatter = followed(played, 60.0, 1800.0, mean=True).scatter
    assert not scatter.excessive.any()
    assert np.mean(scatter.measured / scatter.stated) == pytest.approx(1.0, abs=0.1)


def test_noise_as_stated_is_excessive_as_rarely_as_stated():
    played = Played(2000, 3, period=10.0)
    fleet = Fleet(played.scene, played.count, played.period)
    for number in range(1, BALANCES + 1):
        fleet.add(10.0 * number, played.row(10.0 * number))
    assert fleet.scatter.excessive.sum() <= 3  # of 0.2 expected
    assert RARE * played.count < 1.0
    assert np.isfinite(fleet.scatter.measured).all()


def test_the_gain_of_a_sensor_is_no_scatter_and_noise_is():
    played = Played(20, 4, period=10.0)
    played.gain[1][:5] += 0.1
    fleet, chance = Fleet(played.scene, 20, 10.0), np.random.default_rng(5)
    for number in range(1, BALANCES + 1):
        row = played.row(10.0 * number)
        row["input_torque"][5:10] += 0.6 * chance.standard_normal(5)
        fleet.add(10.0 * number, row)
    assert np.flatnonzero(fleet.scatter.excessive).tolist() == [5, 6, 7, 8, 9]
    assert fleet.scatter.measured[5:10] == pytest.approx(0.62, rel=0.5)


def write(path, rows):
    with path.open("w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["gearbox", "time", "input_torque", "output_torque", "input_speed"])
        table.writerows(rows)


def test_command_names_gearboxes_and_the_steps_that_are_hidden(tmp_path):
    path, played = tmp_path / "scada.csv", Wandering(2, 9, 0.01)
    write(
        path,
        (
            (f"G{n}", time, *(row[name][n] for name in list(row)[:3]))
            for time, row in played.rows(10.0, 600.0, mean=False)
            for n in range(2)
        ),
    )
    said = run_here("fleet", "wind_turbine_stage", "--from", path, "--out", tmp_path / "state.csv")
    assert "none changed; 2 may hide a step of 10 % in their scatter" in said.stdout
    (line,) = (line for line in said.stderr.splitlines() if "scatters" in line)
    assert line.startswith("planetary-twin: warning: G0, G1: the torque balance scatters by ")
    with (tmp_path / "state.csv").open() as file:
        state = list(csv.DictReader(file))
    assert all(float(one["scatter"]) > 1e5 and float(one["smallest_step"]) > 0.1 for one in state)


def test_gearboxes_with_rows_at_different_times_are_refused(tmp_path):
    path = tmp_path / "scada.csv"
    write(path, ((g, 10 * k + t, 60, 139, 100) for k in range(9) for g, t in (("A", 0), ("B", 3))))
    with pytest.raises(ValueError, match=r"rows at different times: .* multiples of 10 s"):
        read_fleet(path, ("A", "B"))
    assert len(read_fleet(path, ("B",)).time) == 9
