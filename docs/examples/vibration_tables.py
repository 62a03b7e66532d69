"""Tables of a vibration: at constant speed, and during a run-up with the measured speed."""

import numpy as np

time = np.arange(0.0, 1.0, 1.0 / 25600.0)
turns = 998.0 / 60.0 * time
tone = np.sin(2 * np.pi * 30 * turns)  # 30 teeth of the sun
vibration = 0.8 * tone * (1.0 + 0.1 * np.cos(2 * np.pi * turns))
rows = np.column_stack((time, vibration))
np.savetxt(
    "vibration.csv", rows, delimiter=",", header="time [s],acceleration [m/s^2]", comments=""
)

time = np.arange(0.0, 2.0, 1.0 / 25600.0)
speed = 900.0 + 100.0 * time  # [rpm]
turns = (900.0 * time + 50.0 * time**2) / 60.0
vibration = 0.8 * np.sin(2 * np.pi * 30 * turns) * (1.0 + 0.1 * np.cos(2 * np.pi * turns))
rows = np.column_stack((time, vibration, speed))
header = "time [s],acceleration [m/s^2],speed [rpm]"
np.savetxt("run_up.csv", rows, delimiter=",", header=header, comments="", fmt="%.9g")
