"""A table as of a SCADA system: six gearboxes, of which the friction of one rises."""

import csv

import numpy as np

import planetary_twin_py as pt

scene = pt.load_scene("paper")
losses = {}
for torque in (57.0, 63.0, 69.0):
    run = pt.simulate(scene.replace(input_torque=torque, dynamics="quasi_static"), 0.1)
    losses[torque] = run.mean_power_loss / scene.operating_point.input_speed
chance = np.random.default_rng(0)
with open("scada.csv", "w", newline="") as file:
    table = csv.writer(file)
    units = ["input_speed [rpm]", "oil_temperature [degC]"]
    table.writerow(["gearbox", "time", "input_torque", "output_torque", *units])
    for second in range(10, 3610, 10):
        for number in range(6):
            torque = 63.0 + 2.0 * chance.standard_normal()
            loss = np.interp(torque, list(losses), list(losses.values()))
            loss *= 1.2 if number == 2 and second > 1800 else 1.0
            ends = [torque, (torque - loss) * 7.0 / 3.0] + 0.05 * chance.standard_normal(2)
            table.writerow([f"G{number}", second, *ends, 1000.0, 70.0])
