"""The law of docs/howto/friction-law.md is followed, and the energy ledger closes."""

import numpy as np

import planetary_twin_py as pt

changes = {"lubrication.traction": "coulomb", "lubrication.boundary_coefficient": 0.05}
run = pt.simulate(pt.load_scene("paper").replace(**changes), duration=0.05)
coefficient = run.boundary_friction / run.mesh_force
assert np.nanmax(coefficient) < 0.0500001 and np.nanmax(coefficient) > 0.0499
assert not run.viscous_friction.any()
assert abs(run.energy.residual) < 1e-4 * run.energy.input
print(f"efficiency {run.efficiency:.4f}")
