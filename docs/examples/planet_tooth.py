"""A chipped tooth of one of three planets, in the signal of a sensor on the ring."""

import numpy as np

import planetary_twin_py as pt

time = np.arange(0.0, 40.0, 1.0 / 8000.0)
turns = 2.0 * time + 0.01 * time**2  # of the carrier
signal = 0.1 * np.random.default_rng(1).normal(size=len(time))
for planet in range(3):
    way = np.cos(np.pi * (turns + planet / 3)) ** 8  # from this planet to the sensor
    signal += way * np.cos(2 * np.pi * 91 * (turns + planet / 3))
    if planet == 0:
        away = (91 * turns - 11 + 18.5) % 37 - 18.5  # teeth from tooth 11 of this planet
        signal += way * np.exp(-((away / 0.4) ** 2)) * np.cos(2 * np.pi * 3.3 * away)

pulses = np.interp(np.arange(95), turns, time)
shaft = pt.tachometer_angle(np.delete(pulses, 30), time)
print("missing pulse at", shaft.missing, "s")

planet = pt.separate(signal[shaft.inside], shaft.angle, (17, 37, 91), planets=3)
parts = pt.gear_signals(planet.average, 37)
print("tooth", planet.tooth[abs(parts.difference).argmax()])  # 31: tooth 11 - 91, modulo 37 teeth
found = pt.condition_indicators(planet.average, 37)
print("FM4", found.fm4, found.reasons)
