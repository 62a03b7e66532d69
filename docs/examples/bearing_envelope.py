"""Impacts of a bearing, hidden by mesh harmonics, by the spectrum of the squared envelope."""

import numpy as np

import planetary_twin_py as pt

random, rate = np.random.default_rng(2), 12_800.0
time = np.arange(0.0, 10.0, 1.0 / rate)
impacts = np.cumsum((1.0 + 0.01 * random.normal(size=369)) / 37.0)  # slip of 1 %
last = np.maximum(np.searchsorted(impacts, time, "right") - 1, 0)
since = time - impacts[last]
ringing = np.where(since > 0.0, np.exp(-1500.0 * since) * np.sin(2 * np.pi * 3000.0 * since), 0.0)
meshing = 5.0 * np.cos(2 * np.pi * 499.0 * time) + 3.0 * np.cos(2 * np.pi * 998.0 * time)
vibration = ringing + meshing + 0.02 * random.normal(size=len(time))

kurtosis = pt.spectral_kurtosis(vibration, rate)
print(f"impacts at {kurtosis.frequency[kurtosis.kurtosis.argmax()]:.0f} Hz")

whitened = pt.pre_whitened(vibration)
envelope = pt.squared_envelope_spectrum(whitened, rate, band=(2000.0, 4000.0))
print(pt.strongest_lines(*envelope, count=2))
