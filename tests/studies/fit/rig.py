"""Recordings of a simulated test rig with known parameters: a twin with sensor noise."""

from pathlib import Path

import numpy as np
from twin_recording import START_NS, TwinRecording

import planetary_twin_py as pt

PAPER = pt.load_scene("paper")
LIGHT = pt.load_scene("lightly_loaded")
NOISY = ("_dte_rms", "_dte_mean", "power_loss", "input_torque", "output_torque", "efficiency")


def noisy(seed: int, share: float):
    """Sensors that read each value of an interval, or sample, with a normal error."""
    rng = np.random.default_rng(seed)

    def alter(topic, number, row):
        if topic == "gearbox_state":
            for name in [name for name in row if name.endswith(NOISY)]:
                value = np.asarray(row[name])
                read = value * (1.0 + share * rng.standard_normal(value.shape))
                row[name] = read if value.ndim else float(read)
        elif topic == "mesh_waveform":
            dte = row["dte"]
            row["dte"] = (dte + share * dte.std() * rng.standard_normal(dte.shape)).astype("f4")
        return row

    return alter


def record(folder: Path, scene: pt.Scene, duration=0.3, seed=0, share=0.0, changes=()) -> Path:
    """A run of intervals of 10 ms; `changes` are pairs of an instant and the values set then."""
    twin = pt.Twin(scene, 20_000.0, 1e-3)
    recording = TwinRecording(folder, noisy(seed, share))
    recording.begin(twin, START_NS)
    due = list(changes)
    for _ in range(round(duration / 0.01)):
        while due and due[0][0] <= twin.time + 1e-9:
            twin.set(**due.pop(0)[1])
            recording.point(twin)
        recording.advance(twin, 0.01)
    recording.finish()
    return folder
