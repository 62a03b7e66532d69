"""Free waves that are stored for the same step of the next mesh cycle."""

import numpy as np

import planetary_twin_py as pt

# Close edges of its meshes force steps of 0.06 us, in which all modes count as free masses.
SCENE = pt.load_scene("paper").replace(
    **{
        "gearset.teeth": {"sun": 40, "planet": 30, "ring": 100},
        "gearset.planet_angles": (0.0, np.pi),
        "input_speed": -950.05,
        "input_torque": -103.91,
        "backlash": 0.0,
        "mesh.sun_planet_stiffness": 9.032e7,
        "mesh.planet_ring_stiffness": 6.217e7,
        "mesh.double_pair_ratio": 1.0557,
        "mesh.ramp": 0.1,
        "mesh.damping.law": "viscous",
    }
)


def test_waves_of_a_step_with_free_masses_serve_a_longer_one():
    found, expected = (
        pt.simulate(SCENE, 0.002, 1e5, tolerance=tolerance, method=method).dte
        for tolerance, method in ((1e-7, "auto"), (1e-7, "rosenbrock"))
    )
    assert np.abs(found - expected).max() < 1e-5 * np.abs(expected).max()
