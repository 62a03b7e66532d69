"""Runs whose axes tilt against a model of vectors in space, integrated by SciPy."""

import numpy as np
import pytest
from integrators.test_reference import errors
from planar.test_reference_in_plane import absolute
from power_flows import FLOWS
from spatial.reference_in_space import SpatialReference
from spatial.tilting_scenes import spatial

from planetary_twin_py.model.bodies import tilts_of

ERRORS = {"errors.pin_tangential": [-2e-5, 1e-5, 0.0], "lubrication.friction": False}


def absolute_in_space(engine, reference):
    """Coordinates, speeds and trim as the reference has them, and sides."""
    plane, sides = absolute(engine, reference)
    middle = len(plane) // 2
    place, radii = engine.gearbox.bodies.place, engine.gearbox.planar_radii
    state, more = engine.integrator.end, []
    for name in ("sun", "ring", "carrier", *(f"planet_{i + 1}" for i in range(reference.n))):
        more += [(f"{name}.z", 1.0)]
        more += [(f"{name}.{tilt}", radii[name.split("_")[0]]) for tilt in tilts_of(name)]
    x, v = (np.array([way[place[name]] / r for name, r in more]) for way in (state.x, state.v))
    return np.concatenate([plane[:middle], x, plane[middle:-1], v, plane[-1:]]), sides


@pytest.mark.parametrize(
    "flow",
    [
        pytest.param(FLOWS[0], id="held carrier", marks=pytest.mark.exhaustive),
        pytest.param(FLOWS[2], id="turning carrier"),
    ],
)
def test_steady_running_converges_to_the_reference(flow):
    scene = spatial(flow, helix=0.2, **ERRORS)
    tolerances = [1e-4, 1e-6]
    found, _ = errors(scene, 1e-3, 2e-3, tolerances, SpatialReference, absolute_in_space)
    assert found[0] < 5e-4
    assert found[1] < 2e-5
