"""Runs that leave all sense stop; what merely is hard does not."""

import signal

import numpy as np
import pytest
from command_line import run_here
from stability.sound import PAPER, static_force

import planetary_twin_py as pt
from planetary_twin_py.run.engine import Engine

# Teeth of rubber, into which 63 N m press one another by 0.94 mm; a base pitch is 2.34 mm.
SOFT = {"mesh.sun_planet_stiffness": 2e6, "mesh.planet_ring_stiffness": 2e6}
PITCH = np.pi * 0.8e-3 * np.cos(np.deg2rad(21.34))

# Tilting flanks of light bodies in wide clearances, whose contact changes every 0.3 ns.
LOOSE = {
    "dynamics": "spatial",
    "gearset.teeth": {"sun": 63, "planet": 48, "ring": 159},
    "gearset.module": 3.9411e-4,
    "gearset.pressure_angle": np.deg2rad(20.0),
    "gearset.helix_angle": 0.28979,
    "gearset.addendum": 0.8,
    "gearset.face_width": 8.479e-3,
    "gearset.planet_angles": tuple(2.0 * np.pi / 222.0 * np.array([0, 37, 74, 112, 147, 185])),
    "gearset.held": "none",
    "gearset.equivalent_mass": {"sun": 0.0102, "planet": 0.0077, "ring": 0.0895, "carrier": 0.0108},
    "gearset.planet_mass": 0.0186,
    "mesh.sun_planet_stiffness": 5e7,
    "mesh.planet_ring_stiffness": 5e7,
    "mesh.double_pair_ratio": 1.0,
    "mesh.damping.loss_factor": 0.03,
    "mesh.sun_planet_error": {"amplitudes": (6.75e-7, 5e-7), "phases": (-0.57, 0.3)},
    "lubrication.friction": False,
    "drive.input": {
        "member": "ring",
        "inertia": 8.21e-6,
        "coupling_stiffness": 18.1,
        "coupling_damping": 2.15e-3,
    },
    "drive.second_input": {
        "member": "sun",
        "inertia": 1.42e-5,
        "coupling_stiffness": 926.0,
        "coupling_damping": 3.35e-3,
    },
    "drive.output": {
        "member": "carrier",
        "inertia": 5.74e-4,
        "coupling_stiffness": 54.7,
        "coupling_damping": 7.35e-3,
    },
    "backlash": 2e-4,
    "input_speed": -0.1759,
    "second_input_speed": 5.3313,
    "input_torque": 10.0,
    "supports": {
        "sun": {"mass": 0.00642, "bearing": 7.88e8, "axial": 2.4e7, "tilting": 2.16e8},
        "planet": {
            "mass": 0.0191,
            "bearing": 1.71e7,
            "clearance": 5e-5,
            "axial": 1.03e7,
            "tilting": 3.16e7,
        },
        "ring": {"mass": 0.167, "bearing": 5.73e6, "axial": 1.89e7, "tilting": 3.33e7},
        "carrier": {"mass": 0.0305, "bearing": 5.75e7, "axial": 1.23e8, "tilting": 8.82e7},
    },
    "errors": {"pin_tangential": (-3.51e-5, -2.39e-5, 4.77e-8, -5.38e-5, -4.39e-5, 1.02e-5)},
}


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
    made = run_here(
        "simulate", "paper", "--duration", "0.01", "--set", "input_torque=500",
        *(part for name, value in SOFT.items() for part in ("--set", f"{name}={value:g}")),
    )  # fmt: skip
    assert made.returncode == 1
    *echoes, line = made.stderr.splitlines()
    assert line.startswith("planetary-twin: the run stops ")
    assert len(echoes) == 1 + len(SOFT)  # of the settings, in their units


def test_a_run_without_progress_stops_and_says_what_keeps_it():
    """With steps of at most 1 ps, put in behind the step control."""
    engine = Engine(PAPER, 1e-4)
    engine.control.longest = 1e-12
    with pytest.raises(pt.RunawayError, match="makes no progress, its last step is 1e-12 s long"):
        engine.sample(1.0)
    assert engine.control.steps <= 60_000


def test_a_run_whose_flanks_keep_it_names_the_mesh():
    """Light bodies in wide clearances, with pins far from their places: see the scene."""
    with pytest.raises(pt.RunawayError, match=r"flanks of planet_ring_. engage and separate"):
        Engine(PAPER.replace(**LOOSE), 1e-4).sample(5e-4)


@pytest.mark.parametrize("window", [True, False])
def test_an_interrupt_ends_a_call_of_the_core_at_once(window):
    """A signal, in place of Ctrl-C, half a second into a call that takes much longer."""
    twin = pt.Twin(PAPER.replace(**{"drive.input.port": "torque"}), 1e3, tolerance=1e-8)
    engine = twin._engine
    engine._stops = lambda *_: ()  # at these, every 0.1 s, Python sees signals anyway

    def advance(until):
        return twin.advance(until) if window else engine.sample(until)

    def interrupt(*_):
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGALRM, interrupt)
    signal.setitimer(signal.ITIMER_REAL, 0.5)
    try:
        with pytest.raises(KeyboardInterrupt):
            advance(60.0)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
    assert 0.0 < engine.reached < 60
    with pytest.raises(pt.RunawayError, match="was interrupted near"):
        advance(0.01)
