"""A run whose flanks would part at an end of the face says so."""

import warnings

import numpy as np
import pytest
from spatial.test_spatial_dynamics import constant, tilting_of_teeth

import planetary_twin_py as pt
from planetary_twin_py.checks.face_contact import uneven_deflection


def test_squeeze_at_an_end_follows_from_the_moment_of_the_teeth():
    """A mesh of stiffness k with the slope s has the moment k L^2 s/12 and the force F = k q, so
    s L/2 over q is 6 times moment over F L. Here of both meshes of a planet, one of which leads."""
    scene = constant(("carrier", "sun", "ring", 63.0))
    run = pt.simulate(scene, 0.01)
    moment = np.linalg.norm(tilting_of_teeth(scene, run, 3))
    force = abs(run.mesh["mesh_force_mean"][0])
    found = uneven_deflection(scene, run)
    of_both = 6.0 * moment / (force * scene.gearset.face_width)
    assert 0.5 * of_both < found < 1.5 * of_both


def test_soft_bearings_warn_and_stiff_ones_do_not():
    stiff = {f"supports.{body}.tilting": 1e12 for body in ("sun", "planet", "ring", "carrier")}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        run = pt.simulate(constant(("carrier", "sun", "ring", 63.0), **stiff), 0.01)
    assert run.axes.tilting is not None
    soft = constant(("carrier", "sun", "ring", 63.0), **{"supports.planet.tilting": 1e5})
    with pytest.warns(pt.AccuracyWarning, match="flanks of a mesh separate"):
        pt.simulate(soft, 0.01)
