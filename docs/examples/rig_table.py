"""A table as of a test rig: scene `paper` with a thinner film and 60 N m, 1 % of noise."""

import csv

import numpy as np

import planetary_twin_py as pt

rig = pt.Twin(pt.load_scene("paper").replace(lambda_ratio=0.8, input_torque=60.0))
noise = np.random.default_rng(0)
meshes = [f"sun_planet_dte_rms_{n} [um]" for n in (1, 2, 3)]
with open("rig.csv", "w", newline="") as file:
    table = csv.writer(file)
    table.writerow(["time", "input_speed [rpm]", "input_torque [Nm]", "power_loss", *meshes])
    for _ in range(30):
        window = rig.advance(0.01)
        dte = 1e6 * window.mesh["dte_rms"][:3]
        sensors = np.array([window.input_torque, window.power_loss, *dte])
        sensors *= 1.0 + 0.01 * noise.standard_normal(len(sensors))
        table.writerow([window.end, 1000.0, *sensors])
