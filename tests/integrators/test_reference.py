"""The compiled model and integrator against an independent one that knows only the scene."""

import math

import numpy as np
import pytest
from planetary_twin_benchmark.samples import samples_until
from power_flows import FLOWS, scene_of
from reference_model import Reference

from planetary_twin_py._core import DTE
from planetary_twin_py.run.engine import Engine

pytestmark = pytest.mark.slow

RATE = 50_000.0
RATTLE = {"input_torque": 0.3, "torque_ripple": 3.0, "drive.speed_control.ripple_order": 6}


def evenly(planets):
    """Angles of planets that all mesh in phase if they are 2 or 5, and in two groups if 4."""
    return tuple(2 * math.pi * k / planets for k in range(planets))


def absolute(engine, _=None):
    """Angles, speeds and the speed loop's integral at the end of the last step, sides."""
    train, state = engine.train, engine.integrator.end
    bodies = int(train.bodies)
    place = np.append(engine.gearbox.body_names.place, [bodies - 2, bodies - 1])
    with_ground = slice(bodies + 1)
    turned = 2 * math.pi * (state.turns + state.fraction)
    angle = train.body.ratio @ turned + state.x / np.where(
        train.body.radius, train.body.radius, 1.0
    )
    speed = train.body.ratio @ state.speed + state.v / np.where(
        train.body.radius, train.body.radius, 1.0
    )
    y = np.concatenate([angle[with_ground][place], speed[with_ground][place], state.trim[:1]])
    return y, state.side[engine.gearbox.mesh_names.place]


def errors(scene, begin, duration, tolerances, model=Reference, state=absolute):
    """Difference of all transmission errors from the reference over their rms, per tolerance."""
    source = Engine(scene, 1e-6)
    source.sample(begin)
    start = source.integrator.end.time
    first, last = math.floor(start * RATE) + 1, round((begin + duration) * RATE)
    times, reference = np.arange(first, last + 1) / RATE, model(scene)
    exact, flank_events = reference.transmission_errors(*state(source, reference), times - start)
    result, place = [], source.gearbox.mesh_names.place if model is Reference else slice(None)
    for tolerance in tolerances:
        engine = Engine(scene, tolerance)
        engine.integrator.end = source.integrator.end
        mine = samples_until(engine, times[-1], first, RATE, len(times)).mesh[:, DTE, place]
        result.append(np.sqrt(np.mean((mine - exact) ** 2) / np.mean(exact**2)))
    return result, flank_events


@pytest.mark.parametrize(
    "flow, changes",
    [
        (FLOWS[0], {}),
        *(
            pytest.param(flow, changes, marks=pytest.mark.exhaustive)
            for flow, changes in (
                (FLOWS[2], {"gearset.planet_angles": evenly(4)}),
                (FLOWS[2], {"input_torque": -40.0}),
                (FLOWS[4], {"mesh.damping.law": "viscous", "backlash": 1e-6}),
                (FLOWS[0], {"gearset.planet_angles": evenly(5)}),
            )
        ),
    ],
    ids=str,
)
def test_steady_running_converges_to_the_reference(flow, changes):
    """To three times the tolerance; what hardly decays adds up to ten at the tightest."""
    found, _ = errors(scene_of(flow, **changes), 0.0, 2.5e-3, [5e-3, 1e-4, 1e-6])
    assert found[0] < 1.5e-2
    assert found[1] < 3e-4
    assert found[2] < 1e-5


def test_rattling_converges_to_the_reference():
    """Impacts carry a difference on tenfold."""
    tolerances = [1e-2, 5e-3, 1e-4, 1e-6]
    found, flank_events = errors(scene_of(FLOWS[0], **RATTLE), 0.02, 4e-3, tolerances)
    assert flank_events >= 5
    assert (np.array(found) < 10.0 * np.array(tolerances)).all()
