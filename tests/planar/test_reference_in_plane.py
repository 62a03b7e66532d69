"""Runs with moving axes against a model of vectors and points, integrated by SciPy."""

import math
from functools import partial

import numpy as np
import pytest
from integrators.test_reference import errors as reference_errors
from planar.moving_scenes import MASSES, planar
from planar.reference_in_plane import PlanarReference
from power_flows import FLOWS


def absolute(engine, reference):
    """Coordinates, speeds and integral of the speed loop at the end of the last step, and sides."""
    train, state = engine.train, engine.integrator.end
    planets, place = engine.scene.gearset.planets, engine.gearbox.bodies.place
    names = [
        "sun",
        *(f"planet_{i + 1}" for i in range(planets)),
        "ring",
        "carrier",
        "motor",
        "load",
    ]
    names += [f"{body}.{motion}" for body in ("sun", "ring", "carrier") for motion in "xy"]
    names += [f"planet_{i + 1}.{motion}" for i in range(planets) for motion in ("xi", "eta")]
    index = np.array([place[name] for name in names])
    radius = np.where(train.body.radius > 0.0, train.body.radius, 1.0)
    turned = 2.0 * math.pi * (state.turns + state.fraction)
    angle = (train.body.ratio @ turned + state.x / radius)[index]
    speed = (train.body.ratio @ state.speed + state.v / radius)[index]
    for i in range(planets):  # along the circle, as a length
        across = reference.at(3 + i) + 1
        angle[across] *= reference.radius
        speed[across] *= reference.radius
    meshes = int(train.meshes)
    return np.concatenate([angle, speed, state.trim[:1]]), state.side[:meshes].copy()


errors = partial(reference_errors, model=PlanarReference, state=absolute)


@pytest.mark.parametrize(
    "flow, changes",
    [
        pytest.param(FLOWS[0], {"errors.pin_tangential": [-2e-5, 0.0, 0.0],
                                "supports.sun.bearing": 0.0, "backlash": 2e-7},
                     marks=pytest.mark.exhaustive),
        (FLOWS[2], {"errors.pin_tangential": [-2e-5, 1e-5, 0.0]}),
    ],
    ids=["both flanks", "turning carrier"],
)  # fmt: skip
def test_steady_running_converges_to_the_reference(flow, changes):
    found, _ = errors(planar(flow, **changes), 1e-3, 2e-3, [1e-4, 1e-6])
    assert found[0] < 5e-4
    assert found[1] < 2e-5


ROLLING = {"rollers": 14, "length": 0.012}


@pytest.mark.exhaustive
@pytest.mark.parametrize("clearance", [0.0, 5e-6])
def test_rolling_bearings_converge_to_the_reference(clearance):
    pins = {"errors.pin_tangential": [-2e-5, 1e-5, 0.0]}
    scene = planar(FLOWS[2], **pins)
    supports = scene.supports.model_dump(exclude_none=True)
    for body in ("sun", "planet"):
        supports[body] = {"mass": MASSES[body], "rolling": ROLLING, "clearance": clearance}
    found, _ = errors(scene.replace(supports=supports), 1e-3, 2e-3, [1e-4, 1e-6])
    assert found[0] < 5e-4
    assert found[1] < 2e-5


@pytest.mark.exhaustive
def test_rattling_with_gaps_and_clearance_converges_to_reference():
    scene = planar(
        FLOWS[0],
        **{
            "input_torque": 0.3,
            "torque_ripple": 3.0,
            "drive.speed_control.ripple_order": 6,
            "backlash": 5e-6,
            "supports.sun.clearance": 2e-6,
        },
    )
    found, flank_events = errors(scene, 0.0235, 4e-3, [1e-4, 1e-6])
    assert flank_events >= 5
    assert found[0] < 2e-3
    assert found[1] < 1e-4
