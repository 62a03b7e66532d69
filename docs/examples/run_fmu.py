"""Runs paper.fmu, the FMU of docs/howto/robot.md, in FMPy."""

import numpy as np
from fmpy import simulate_fmu

given = np.array(
    [(0.0, 63.0, -44.88), (1.0, 70.0, -44.88)],
    dtype=[("time", float), ("input.torque", float), ("output.speed", float)],
)
output = ["input.speed", "output.torque", "sun_planet_1.dte", "power_loss"]
found = simulate_fmu(
    "paper.fmu", stop_time=0.5, output_interval=1e-3, input=given, output=output,
    start_values={"operating_point.backlash": 1e-6},
)  # fmt: skip
print(found[-1])
