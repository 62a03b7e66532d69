"""Files of a run-up: a vibration, the speed in a table of its own, pulses of a tachometer."""

import numpy as np
from scipy.io import wavfile

time = np.arange(0.0, 2.0, 1.0 / 25600.0)
turns = (900.0 * time + 50.0 * time**2) / 60.0
vibration = 0.8 * np.sin(2 * np.pi * 30 * turns) * (1.0 + 0.1 * np.cos(2 * np.pi * turns))
wavfile.write("rig.wav", 25600, vibration.astype(np.float32))
rows = np.column_stack((time[::512], 900.0 + 100.0 * time[::512]))
np.savetxt("speed.csv", rows, delimiter=",", header="time [s],speed [rpm]", comments="")
pulses = np.interp(np.arange(int(turns[-1]) + 1), turns, time)
np.savetxt("pulses.csv", pulses, header="time [s]", comments="")
