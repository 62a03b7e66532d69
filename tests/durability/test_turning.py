"""Open cycles of shafts and temperatures go on in the next run of a gearbox."""

import json

import pytest
from fmu.test_slow_states_of_an_fmu import DURABILITY
from ports.ports_of_paper import PAPER

from planetary_twin_py import Twin
from planetary_twin_py.durability.damage_state import DamageState
from planetary_twin_py.durability.parts import part_names
from planetary_twin_py.durability.rainflow import Rainflow
from planetary_twin_py.durability.run_damage import RunDamage
from planetary_twin_py.durability.state_text import parse_state, state_text

SCENE = PAPER.replace(dynamics="quasi_static", durability=DURABILITY)
RANGE, EXPONENT, CYCLES = DURABILITY["shafts"]["input"].values()
RUNS = (100.0, 20.0), (90.0, 30.0, 110.0, 10.0)  # [N m], each after the torque at the start


def after_runs(continued):
    """Damage of the input shaft after both runs, the second with what is left of the first."""
    run = RunDamage(DamageState(part_names(SCENE)))
    for torques in RUNS:
        twin = Twin(SCENE, 1000.0)
        if continued:
            twin.continue_cycles(run.state.turning)
        run.add(twin.advance(0.01).damage)
        for torque in torques:
            twin.set(input_torque=torque)
            run.add(twin.advance(0.01).damage)
    return run.state.of("input_shaft")


def test_cycles_close_across_runs_as_in_one_history():
    start = SCENE.operating_point.input_torque
    counter = Rainflow()
    counter.feed([value for torques in RUNS for value in (start, *torques)])
    closed = counter.take_closed()
    expected = sum((size / RANGE) ** EXPONENT / CYCLES for size in closed)
    assert closed == [60.0]  # from 90 to 30 N m, within 20 N m of the first run and 110 N m
    assert after_runs(continued=True) == pytest.approx(expected, rel=1e-6)
    assert after_runs(continued=False) < 0.9 * expected


def state_with_temperatures():
    state = DamageState(part_names(SCENE))
    state.turning["input_shaft"] = (63.0, 100.0, 20.000000000000004)
    nodes = ("oil", "sun", "planets", "ring", "housing")
    state.temperatures = dict(zip(nodes, (310.1, 320.2, 330.3, 340.4, 350.5), strict=True))
    return state


def test_temperatures_and_turning_points_return_from_a_text():
    state = state_with_temperatures()
    again = parse_state(state_text(state, SCENE), SCENE, state.parts)
    assert (again.temperatures, again.turning) == (state.temperatures, state.turning)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"oil": 20.0}, r"temperatures\.oil: .*233\.15"),
        ({"oil": None}, r"temperatures\.oil: "),
        ({"gravel": 300.0}, r"temperatures\.gravel: "),
    ],
)
def test_temperatures_that_cannot_be_are_refused(changes, message):
    state = state_with_temperatures()
    content = json.loads(state_text(state, SCENE))
    content["temperatures"] |= changes
    with pytest.raises(ValueError, match=message):
        parse_state(json.dumps(content), SCENE, state.parts)
