"""Runs that leave all sense stop; what merely is hard does not."""

import numpy as np
import pytest
from command_line import run
from stability.sound import PAPER, static_force

import planetary_twin_py as pt
from planetary_twin_py.dynamics.speed_loop import FIELD, speed_loop_gains
from planetary_twin_py.engine import Engine

# Teeth of rubber, into which 63 N m press one another by 0.94 mm; a base pitch is 2.34 mm.
SOFT = {"mesh.sun_planet_stiffness": 2e6, "mesh.planet_ring_stiffness": 2e6}
PITCH = np.pi * 0.8e-3 * np.cos(np.deg2rad(21.34))


def breaking_torque(scene):
    """At which the meshes yield by a base pitch at rest [N m]."""
    return PITCH / (static_force(scene) / scene.mesh.sun_planet_stiffness) * 63.0


@pytest.mark.parametrize("dynamics", ["torsional", "quasi_static"])
def test_teeth_that_yield_by_a_base_pitch_stop_the_run(dynamics):
    scene = PAPER.replace(dynamics=dynamics, **SOFT, **{"mesh.double_pair_ratio": 1.0})
    scene = scene.replace(**{"lubrication.friction": False}) if dynamics == "torsional" else scene
    torque = breaking_torque(scene)
    assert np.abs(pt.simulate(scene.replace(input_torque=0.95 * torque), 0.01).dte).max() < PITCH
    with pytest.raises(pt.RunawayError, match=r"deflection of .* base pitch"):
        pt.simulate(scene.replace(input_torque=1.05 * torque), 0.01)


@pytest.mark.exhaustive  # the command that runs away is a test below
def test_a_drive_that_runs_away_is_stopped_before_its_numbers_overflow():
    """The loop of 3 Hz on a heavy load grows by 1.16/s: put in behind the check."""
    scene = PAPER.replace(**{"drive.output.inertia": 135.0, "lubrication.friction": False})
    engine = Engine(scene, 1e-2)
    gains = speed_loop_gains(scene, engine.train, 20.0)
    engine.model.load.proportional = gains.proportional
    engine.model.load.trim_gain = gains.trim
    with pytest.raises(pt.RunawayError) as error:
        engine.advance(60.0, 1, 100.0, 6000)
    assert "must be at most" in str(error.value) and "\n" not in str(error.value)
    assert engine.reached < 10
    for again in (lambda: engine.advance(61.0, 1, 1.0, 0), lambda: engine.sample(60.0)):
        with pytest.raises(pt.RunawayError):
            again()


def test_a_twin_stays_where_it_was_when_its_train_breaks():
    twin = pt.Twin(PAPER.replace(**SOFT))
    twin.advance(0.01)
    twin.set(input_torque=500.0)
    with pytest.raises(pt.RunawayError):
        twin.advance(0.01)
    assert twin.time == 0.01
    with pytest.raises(pt.RunawayError):
        twin.set(input_torque=63.0)
    assert twin.operating_point.input_torque == 500.0


@pytest.mark.parametrize(
    ("limit", "value"),
    [("speed", 10.1 * 1100.0), ("torque", 10.1 * (1000.0 + 500.0 * 0.02)), ("deflection", 2.4e-3)],
)
def test_each_limit_is_the_documented_one(limit, value):
    """10 times drive.speed_limit; 10 times drive.torque_limit and J slew_rate; a base pitch."""
    checked = getattr(Engine(PAPER, 1e-2)._limits, limit)
    sun = {"speed": "sun", "torque": "motor", "deflection": "sun_planet_1"}[limit]
    place = list(checked.names).index(sun)
    values = np.zeros((2, len(checked.names)))
    values[1, place] = 0.95 * value
    checked.check(values)
    values[1, place] = np.nan
    with pytest.raises(ArithmeticError, match=f"{limit} of {sun} = nan .*: must be a number"):
        checked.check(values)
    values[1, place] = -value
    with pytest.raises(ArithmeticError, match=f"{limit} of {sun} = "):
        checked.check(values)


def test_the_command_ends_with_exit_code_1_and_one_line():
    made = run(
        "simulate", "paper", "--duration", "0.01", "--set", "input_torque=500",
        *(part for name, value in SOFT.items() for part in ("--set", f"{name}={value:g}")),
    )  # fmt: skip
    assert made.returncode == 1
    *echoes, line = made.stderr.splitlines()
    assert line.startswith("planetary-twin: the run stops ")
    assert len(echoes) == 1 + len(SOFT)  # of the settings, in their units


def test_a_point_of_a_sweep_that_runs_away_has_a_reason_instead_of_figures():
    found = list(pt.simulate_many([PAPER.replace(**SOFT, input_torque=500.0)], 0.01))
    assert isinstance(found[0].found, pt.RunawayError)


def test_a_loop_that_is_not_stable_ends_a_command_with_exit_code_2():
    made = run("simulate", "paper", "--set", f"{FIELD}=60")
    assert made.returncode == 2
    line = made.stderr.splitlines()[-1]
    assert line.startswith(f"planetary-twin: {FIELD} = 60 Hz: must be at most ")
