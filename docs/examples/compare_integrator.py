"""Error of the explicit method of docs/howto/integrator.md against its tolerance."""

import planetary_twin_py as pt

scene = pt.load_scene("paper")
best = pt.simulate(scene, 0.01, method="march", tolerance=1e-7)
errors = []
for tolerance in (1e-3, 1e-4, 1e-5):
    run = pt.simulate(scene, 0.01, method="explicit", tolerance=tolerance)
    errors.append(abs(run.dte - best.dte).max() / best.dte.std())
    print(f"{tolerance:g}: error {errors[-1]:.1e}, {run.stats.steps} steps")
assert errors[0] > errors[1] > errors[2]
assert errors[-1] < 1e-3
