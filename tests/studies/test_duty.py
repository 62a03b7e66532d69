"""Duty cycles: energies are sums over the rows of steady runs, and bad tables are refused."""

import json

import pytest
from command_line import succeed

import planetary_twin_py as pt
from planetary_twin_py.simulation.threads import Threads
from planetary_twin_py.studies.duty import read_cycle, study_of, summary_of_duty
from planetary_twin_py.studies.plan import Settings
from planetary_twin_py.studies.sweep import sweep

STILL = pt.load_scene("paper").replace(dynamics="quasi_static")
CYCLE = """time,torque [N m],speed [rpm]
0,20,1000
10,40,2000
15,20,1000
30,0,0
40,-10,1500
50,0,0
"""


@pytest.fixture
def cycle(tmp_path):
    path = tmp_path / "cycle.csv"
    path.write_text(CYCLE)
    return path


def test_energies_are_those_of_steady_runs_of_its_rows(cycle):
    duty = read_cycle(cycle)
    study, place = study_of(duty, STILL, Settings(0.05, 0.0))
    assert len(study.points) == 4 and place[0] == place[2]
    found = summary_of_duty(duty, place, sweep(study, Threads(1)))
    lost = driving = 0.0
    for torque, speed, seconds in (
        (20.0, 1000.0, 25.0),
        (40.0, 2000.0, 5.0),
        (-10.0, 1500.0, 10.0),
    ):
        run = pt.simulate(STILL.replace(input_torque=torque, input_speed=pt.rpm(speed)), 0.05)
        lost += seconds * run.mean_power_loss
        # The load drives where the torque is negative, and covers the losses as well.
        given = abs(torque) * pt.rpm(speed) + (run.mean_power_loss if torque < 0.0 else 0.0)
        driving += seconds * given
    assert found.loss_energy == pytest.approx(lost, rel=2e-3)
    assert found.driving_energy == pytest.approx(driving, rel=1e-3)
    assert found.efficiency == pytest.approx(1.0 - lost / driving, rel=1e-4)
    assert found.duration == 50.0
    largest, at = found.peaks["sun_planet_mesh_force_peak"]
    assert at == 10.0 and largest > 0.0


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("time,torque\n0,1\n1,1\n", "input_speed"),
        ("time,torque,speed,colour\n0,1,1,1\n1,1,1,1\n", "'colour': no such quantity"),
        ("time,torque,speed\n0,1,1\n0,1,1\n", "row 2: time = 0 s: must increase"),
        ("time,torque,speed\n0,1,\n1,1,1\n", "row 1: input_speed is missing"),
        ("time,torque,speed\n0,1,1\n", "two rows or more"),
        ("time,torque [rpm],speed\n0,1,1\n1,1,1\n", "rpm"),
    ],
)
def test_a_table_that_is_no_duty_cycle_is_refused_in_one_line(tmp_path, text, reason):
    path = tmp_path / "bad.csv"
    path.write_text(text)
    with pytest.raises(ValueError, match=reason) as refusal:
        read_cycle(path)
    assert "\n" not in str(refusal.value)


def test_sums_without_some_operating_points_are_refused(cycle):
    duty = read_cycle(cycle)
    limited = STILL.replace(**{"drive.torque_limit": 30.0, "input_torque": 10.0})
    study, place = study_of(duty, limited, Settings(0.01, 0.0))
    with pytest.raises(ValueError, match=r"1 of 4 operating points failed, which hold for 5 s"):
        summary_of_duty(duty, place, sweep(study, Threads(1)))


def test_the_command_prints_sums_and_writes_the_operating_points(cycle, tmp_path):
    out = tmp_path / "points.csv"
    arguments = ["duty", "paper", str(cycle), "--set", "dynamics=quasi_static", "--out", str(out)]
    done = succeed(*arguments, "--json", "-")
    figures = json.loads(done.stdout)
    assert figures["efficiency"] == pytest.approx(0.9885, abs=5e-4)
    assert "duty cycle of 50 s, 4 operating points" in done.stderr
    assert len(out.read_text().splitlines()) == 5
    assert not (tmp_path / "points.csv.journal").exists()
