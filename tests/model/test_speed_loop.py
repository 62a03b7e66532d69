"""The speed loop against closed forms, other models and runs in time."""

import math

import numpy as np
import pytest
from model.rigid_gears import RigidGears
from planetary_twin_benchmark.samples import samples_until
from power_flows import ALL_FLOWS, DIFFERENTIALS, scene_of
from stability.sound import PAPER, PLAIN

import planetary_twin_py as pt
from planetary_twin_py.model.gearbox import Gearbox
from planetary_twin_py.model.speed_loop import LinearTrain, speed_loop_gains
from planetary_twin_py.model.speed_loop_check import FIELD, SpeedLoopCheck
from planetary_twin_py.run.engine import Engine

WIND = pt.load_scene("wind_turbine_stage")
HEAVY = PAPER.replace(**{"drive.output.inertia": 135.0})  # a vehicle on an e-axle
UNDAMPED = PLAIN.replace(
    **{
        "mesh.damping.damping_ratio": 0.0,
        "drive.input.coupling_damping": 0.0,
        "drive.output.coupling_damping": 0.0,
    }
)
LIGHT = dict.fromkeys(("sun", "planet", "ring", "carrier"), 1e-5)


def loop_of(scene, mesh_frequency=500.0):
    gearbox = Gearbox(scene)
    return LinearTrain(gearbox, gearbox.train).loop(mesh_frequency)


@pytest.mark.parametrize("share", [1e-3, 0.1, 0.5, 0.9, 0.99])
def test_two_masses_are_stable_up_to_the_limit_of_routh(share):
    """J w^2/4 = k, whatever share of the inertia J the motor has."""
    ratio, total, shaft = 3.0 / 7.0, 0.02, 500.0
    scene = UNDAMPED.replace(
        **{
            "mesh.sun_planet_stiffness": 1e10,
            "mesh.planet_ring_stiffness": 1e10,
            "gearset.equivalent_mass": LIGHT,
            "gearset.planet_mass": 1e-5,
            "drive.input.inertia": share * total,
            "drive.input.coupling_stiffness": shaft,
            "drive.output.inertia": (1.0 - share) * total / ratio**2,
            "drive.output.coupling_stiffness": 1e9,
        }
    )
    limit = math.sqrt(4.0 * shaft / total) / math.tau
    assert loop_of(scene).limit(100.0) == pytest.approx(limit, rel=1e-3)


def test_without_a_loop_eigenvalues_are_natural_modes():
    loop = loop_of(UNDAMPED)
    found = np.sort(np.abs(loop.eigenvalues(1e-9).imag))[::2] / math.tau
    frequencies = pt.natural_modes(UNDAMPED, "machines", "mean").frequencies
    assert found == pytest.approx(frequencies, rel=1e-9, abs=1e-6)


def rate_of_growth(engine, begin, end, period):
    """Least squares: the motor's speed as a decaying or growing oscillation [1/s]."""
    first = round(begin / period)
    room = round((end - begin) / period)
    seen = samples_until(engine, end, first, 1.0 / period, room).speed
    y = seen[:, int(engine.train.coupling.ends[0, 0])]
    y = np.diff(y)  # without the mean
    two, one = np.linalg.lstsq(np.stack([y[:-2], y[1:-1]], 1), y[2:])[0]
    return math.log(np.abs(np.roots([1.0, -one, -two])).max()) / period


@pytest.mark.parametrize("chosen", [25.0, 50.0])
def test_a_run_decays_or_grows_as_the_eigenvalues_say(chosen):
    """Below and above the limit of 43.7 Hz; beyond it the gains are put in by hand."""
    scene = PLAIN.replace(
        input_torque=20.0, **{FIELD: 25.0, "drive.speed_control.start_speed": pt.rpm(999.0)}
    )
    engine = Engine(scene, 1e-6, "march")
    gains = speed_loop_gains(engine.gearbox, engine.train, chosen)
    engine.model.operation.proportional = gains.proportional
    engine.model.operation.trim_gain = gains.trim
    slowest = max(loop_of(scene).eigenvalues(chosen), key=lambda value: value.real)
    assert (slowest.real > 0.0) == (chosen > 43.7)
    period = 0.1 / abs(slowest.imag)
    measured = rate_of_growth(engine, 0.15, 0.3, period)
    assert measured == pytest.approx(slowest.real, rel=0.02)


DRIVES = [(ratio, coupling) for ratio in (1e-3, 1.0, 1e3) for coupling in (1e1, 1e4, 1e9)]


@ALL_FLOWS
def test_every_default_is_steady_and_growing_loops_are_refused(flow):
    """By another model, with rigid gears, stepped in time; inertia of the load, couplings."""
    refused = 0
    for ratio, coupling in DRIVES:
        sides = ["input", "output", *["second_input"] * (flow in DIFFERENTIALS)]
        couplings = {f"drive.{side}.coupling_stiffness": coupling for side in sides}
        scene = scene_of(flow, **{"drive.output.inertia": 5e-2 * ratio}, **couplings)
        gearbox, point = Gearbox(scene), scene.operating_point
        chosen = gearbox.bandwidth
        SpeedLoopCheck(gearbox).check(point)
        rigid, time = RigidGears(scene, chosen), 10.0 / chosen
        assert rigid.growth(2.0 * time) <= rigid.growth(time) < 1.0
        fast = scene.replace(**{FIELD: 3.0})
        grows = RigidGears(fast, 3.0).growth(30.0) > 1.0
        if grows:
            refused += 1
            with pytest.raises(pt.SceneError):
                SpeedLoopCheck(Gearbox(fast)).check(point)
    assert refused >= 1


@pytest.mark.parametrize("point", [{"input_speed": 0.0}, {"backlash": 0.0, "torque_ripple": 5.0}])
def test_the_default_does_not_follow_the_operating_point(point):
    assert Gearbox(HEAVY.replace(**point)).bandwidth == Gearbox(HEAVY).bandwidth < 3.0


@pytest.mark.parametrize("scene", [HEAVY, WIND], ids=["e-axle", "wind stage"])
def test_unstable_loop_is_refused_in_a_line_whose_advice_helps(scene):
    with pytest.raises(pt.SceneError) as error:
        pt.Twin(scene.replace(**{FIELD: 3.0}))
    text = str(error.value)
    assert text.startswith(f"{FIELD} = 3 Hz: must be at most ") and "\n" not in text
    largest = float(text.split("at most ")[1].split(" Hz")[0])
    for allowed in (largest, None):
        other = scene.replace(**{FIELD: allowed})
        SpeedLoopCheck(Gearbox(other)).check(other.operating_point)
    above = scene.replace(**{FIELD: 1.1 * largest})
    with pytest.raises(pt.SceneError):
        SpeedLoopCheck(Gearbox(above)).check(above.operating_point)


@pytest.mark.parametrize(
    ("scene", "duration"), [(HEAVY, 10.0), (WIND, 60.0)], ids=["e-axle", "wind stage"]
)
@pytest.mark.slow
def test_drives_with_large_inertias_run_steadily_by_default(scene, duration):
    scene = scene.replace(**{FIELD: None})
    twin = pt.Twin(scene, 1000.0, tolerance=3e-3)
    first = twin.advance(0.1 * duration)
    for _ in range(8):
        last = twin.advance(0.1 * duration)
        assert last.mesh["mesh_force_peak"].max() < 1.2 * first.mesh["mesh_force_peak"].max()
    assert last.input_speed == pytest.approx(scene.operating_point.input_speed, rel=3e-3)


def test_a_speed_of_an_unstable_loop_is_refused():
    """Teeth of rubber are damped at a low speed alone, where tau = loss_factor/f_m is long."""
    soft = PAPER.replace(
        input_speed=pt.rpm(10.0),
        input_torque=0.01,
        **{
            "mesh.sun_planet_stiffness": 2e4,
            "mesh.planet_ring_stiffness": 2e4,
            "mesh.damping.loss_factor": 1.0,
            "drive.output.inertia": 0.5,
        },
    )
    limits = [loop_of(soft, frequency).limit(100.0) for frequency in (5.0, 500.0)]
    assert limits[0] > 2.0 * limits[1]
    scene = soft.replace(**{FIELD: math.sqrt(0.5 * limits[0] * limits[1])})
    with pytest.raises(pt.SceneError, match=FIELD):
        pt.Twin(scene.replace(**{"drive.speed_control.start_speed": pt.rpm(1000.0)}))
    twin, other = pt.Twin(scene), pt.Twin(scene)
    with pytest.raises(pt.SceneError, match=FIELD):
        twin.set(input_speed=pt.rpm(1000.0))
    assert twin.operating_point == scene.operating_point
    forces = [each.advance(0.01).waveform.mesh_force for each in (twin, other)]
    assert np.array_equal(*forces)
