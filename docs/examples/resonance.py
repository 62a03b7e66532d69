"""The resonance of the twin at 41 speeds, beside the natural frequencies of a scene."""

import numpy as np

import planetary_twin_py as pt

changed = {"mesh.double_pair_ratio": 1.2, "drive.speed_limit": pt.rpm(20_000)}
scene = pt.load_scene("paper").replace(**changed)
single, mean = (
    pt.natural_modes(scene, "machines", which).frequencies[3] for which in ("single", "mean")
)

mesh_frequency = np.linspace(5200, 6200, 41)  # 30 mesh cycles a turn
speeds = 2 * np.pi * mesh_frequency / 30
runs = pt.simulate_many((scene.replace(input_speed=speed) for speed in speeds), duration=0.2)
# Of the first ring mesh, which the mode stretches most.
dte = [run.result.dte[:, 3] for run in runs]
vibration = [part[len(part) // 2 :].std() for part in dte]
peak = mesh_frequency[np.argmax(vibration)]
print(f"one pair {single:.0f} Hz, mean {mean:.0f} Hz, peak {peak:.0f} Hz")
