"""A duty of four days in rows of ten minutes."""

import csv

import numpy as np

chance = np.random.default_rng(0)
with open("duty.csv", "w", newline="") as file:
    table = csv.writer(file)
    table.writerow(["time [min]", "torque [kN m]", "speed [rpm]", "torque_std [kN m]"])
    load = 0.6
    for row in range(4 * 144 + 1):
        load = np.clip(load + 0.05 * chance.standard_normal(), 0.2, 1.0)
        table.writerow([10 * row, 4180 * load, 8 + 4 * load, 200 * load])
