"""Readings of ten minutes with a standstill of the logger of an hour in the middle."""

import csv
import math

with open("readings.csv", "w", newline="") as file:
    table = csv.writer(file)
    units = ["input_speed [rpm]", "oil_temperature [degC]"]
    table.writerow(["time", "input_torque", "output_torque", *units])
    for second in range(600):
        torque = 63.0 + 3.0 * math.sin(second / 20.0)
        time = second + (3600 if second >= 300 else 0)
        table.writerow([time, torque, (torque - 0.8) * 7.0 / 3.0, 1000.0, 70.0])
