"""Print a digest of the bits of each of some simulations, to compare with another processor's."""

import hashlib
import warnings

import planetary_twin_py as pt

warnings.simplefilter("ignore")
paper = pt.load_scene("paper")
scenes = {
    "ripple": paper.replace(input_torque=0.3, torque_ripple=3.0),
    "runout": paper.replace(
        backlash=2e-5, **{"mesh.runout.sun": 3e-6, "mesh.runout.ring": 2e-6},
    ),
    "creep": paper.replace(input_speed=0.1),
    "profile shift": pt.load_scene("reference_gearbox_stage"),
    "stiff": paper.replace(input_speed=pt.rpm(30)),
    "quasi-static": paper.replace(dynamics="quasi_static", torque_ripple=3.0),
    "crack": pt.load_scene("cracked_tooth"),
    "floating sun": pt.load_scene("floating_sun"),
    "helical": pt.load_scene("helical_stage"),
}  # fmt: skip
for name, scene in scenes.items():
    run = pt.simulate(scene, 0.02, 20_000.0, tolerance=1e-3)
    parts = (run.dte, run.speed, run.film_thickness, run.total_power_loss)
    print(name, hashlib.sha256(b"".join(part.tobytes() for part in parts)).hexdigest())
