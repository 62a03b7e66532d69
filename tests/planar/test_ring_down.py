"""Small motions of a run ring at the natural frequencies of the planar model."""

import math

import numpy as np
import pytest
from planar.moving_scenes import evenly, planar
from planetary_twin_benchmark.samples import samples_until
from power_flows import FLOWS
from tiers import first

from planetary_twin_py import natural_modes
from planetary_twin_py._core import axes
from planetary_twin_py.run.engine import Engine
from planetary_twin_py.statics.loaded_planets import carrying

RATE = 200_000.0
# Leave the gears to themselves.
SOFT = {"coupling_stiffness": 1e-2, "coupling_damping": 0.0, "inertia": 1.0}
SMALL = 1e-9  # [m]
TINY = 1e-18  # [m] error of one planet, with which each is integrated, in all of its modes


def ringing(flow, planets, speed, build=planar, **changes):
    """A scene without damping or friction, whose teeth are equally stiff at all times."""
    bodies, damping = ("sun", "planet", "ring", "carrier"), ["damping"]
    damping += ["axial_damping", "tilting_damping"] if build is not planar else []
    return build(
        flow,
        **{
            "gearset.planet_angles": evenly(planets),
            "mesh.double_pair_ratio": 1.0,
            "mesh.ramp": 0.0,
            "mesh.damping.law": "viscous",
            "mesh.damping.damping_ratio": 0.0,
            "lubrication.friction": False,
            "drive.speed_control.bandwidth": 1e-3,
            "input_torque": math.copysign(0.5, flow[3]),
            "input_speed": speed,
            "errors.planet_thickness": (TINY, *[0.0] * (planets - 1)),
        }
        | {f"drive.{side}.{name}": SOFT[name] for side in ("input", "output") for name in SOFT}
        | {f"supports.{body}.{name}": 0.0 for body in bodies for name in damping}
        | changes,
    )


def expected(scene, model="planar", at_rest=None):
    """Natural frequencies [Hz] of the gears and their axes alone, but the rigid rotation."""
    if at_rest is None:
        at_rest = scene.gearset.held == "carrier"
    if at_rest:
        found = natural_modes(scene, model).frequencies
    else:
        speed = scene.operating_point.input_speed
        found = natural_modes(scene, model, input_speed=speed).frequencies
    return found[found > 20.0]


def equations(scene):
    """Masses and derivatives of the forces by x and v, in the coordinates of the run."""
    engine = Engine(scene, 1e-6)
    model, state, train = engine.model, engine.integrator.end, engine.train
    step, out, trim = axes.StepConstants(), axes.Evaluation(), np.zeros(2)
    axes.set_step_constants(model, state, step)
    count = int(train.bodies)

    def force(x, v):
        axes.forces(model, state, step, x, v, 0.0, trim, out)
        return out.force[:count].copy()

    slopes = []
    for place in range(2):
        columns = []
        for j in range(count):
            ends = []
            for sign in (1.0, -1.0):
                point = [state.x.copy(), state.v.copy()]
                point[place][j] += sign * (SMALL if place == 0 else 1e-6)
                ends.append(force(*point))
            columns.append((ends[0] - ends[1]) / (2.0 * (SMALL if place == 0 else 1e-6)))
        slopes.append(np.array(columns).T)
    return train.body.mass[:count].copy(), *slopes


def linear(scene):
    """Matrix of small motions about the start of a run, over displacements and speeds."""
    mass, by_x, by_v = equations(scene)
    n = len(mass)
    return np.block([[np.zeros((n, n)), np.eye(n)], [by_x / mass[:, None], by_v / mass[:, None]]])


def frequencies(scene, count):
    """Of the fastest small motions [Hz]."""
    found = np.linalg.eigvals(linear(scene)).imag
    return np.sort(found)[-count:] / (2.0 * math.pi)


@pytest.mark.parametrize("planets", [3, 4, 5])
@pytest.mark.parametrize("flow, speed", [(FLOWS[0], 100.0), (FLOWS[2], 600.0)])
def test_equations_have_the_frequencies_of_the_planar_modes(flow, speed, planets):
    scene = ringing(flow, planets, speed)
    wanted = expected(scene)
    assert frequencies(scene, len(wanted)) == pytest.approx(wanted, rel=1e-6)


def test_pins_with_clearance_swing_as_their_modes():
    scene = ringing(FLOWS[0], 4, 100.0)  # evenly spaced: equal loads
    tight = expected(scene)
    scene = scene.replace(**{"supports.planet.clearance": 1e-6, "input_torque": 3.0})
    wanted = expected(scene)
    assert abs(wanted / tight - 1.0).max() > 0.1
    assert frequencies(scene, len(wanted)) == pytest.approx(wanted, rel=1e-5)


def test_a_planet_without_load_swings_on_its_pin_as_its_modes():
    scene = ringing(FLOWS[0], 4, 100.0)
    equal = expected(scene)
    scene = scene.replace(**{"errors.pin_tangential": (2e-5, 0.0, 0.0, 0.0)})
    assert carrying(scene) == (0.0, 1.0, 1.0, 1.0)
    wanted = expected(scene)
    assert len(wanted) == len(equal) - 1  # the planet turns freely
    assert frequencies(scene, len(wanted)) == pytest.approx(wanted, rel=1e-5)


def swing(scene, mode, size):
    """Start of a run in which one mode swings: its frequency [Hz] and the state."""
    values, vectors = np.linalg.eig(linear(scene))
    n = len(values) // 2
    order = np.argsort(values.imag)
    place = order[values.imag[order] > 2.0 * math.pi * 20.0][mode]
    shape = vectors[:, place] / np.abs(vectors[:n, place]).max() * size
    return values[place].imag / (2.0 * math.pi), shape.real[:n], shape.real[n:]


@pytest.mark.parametrize("mode", first(1, [9, 0, 3]))
@pytest.mark.parametrize("flow, speed", [(FLOWS[0], 100.0), (FLOWS[2], 600.0)])
def test_a_run_rings_at_the_frequency_of_its_mode(flow, speed, mode):
    scene = ringing(flow, 3, speed)
    wanted, x, v = swing(scene, mode, 1e-9)
    engine = Engine(scene, 1e-8, "collocation")
    state = engine.integrator.end
    state.x[: len(x)] += x
    state.v[: len(v)] += v
    engine.control.changed = True
    periods = 40
    samples = round(periods / wanted * RATE)
    motion = samples_until(engine, samples / RATE, 1, RATE, samples)
    axis = (
        np.abs(engine.train.body.ratio[: len(x)]).sum(axis=1) == 0.0
    )  # not what couplings wind up
    k = np.argmax(np.where(axis, np.abs(x), 0.0))
    values = motion.angle[:, k]
    times = np.arange(1, samples + 1) / RATE
    assert frequency(times, values, wanted) == pytest.approx(wanted, rel=1e-4)


def frequency(times, values, guess):
    """Of the sine that fits best, beside a parabola for what else moves."""

    def left(trial):
        phase = 2.0 * math.pi * trial * times
        span = times / times[-1]
        table = np.column_stack([np.sin(phase), np.cos(phase), span**0, span, span**2, span**3])
        return values - table @ np.linalg.lstsq(table, values, rcond=None)[0]

    trials = guess * (1.0 + np.linspace(-4e-3, 4e-3, 161))
    rest = np.array([np.sum(left(trial) ** 2) for trial in trials])
    best = int(np.argmin(rest))
    assert 0 < best < len(trials) - 1
    near = np.polyfit(trials[best - 1 : best + 2] / guess - 1.0, rest[best - 1 : best + 2], 2)
    return guess * (1.0 - near[1] / (2.0 * near[0]))
