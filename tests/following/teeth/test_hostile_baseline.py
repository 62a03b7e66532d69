"""Files that are no baselines end in one line."""

import json

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.following.teeth.baseline import Baseline
from planetary_twin_py.following.teeth.baseline_fields import FIELDS
from planetary_twin_py.following.teeth.baseline_file import VERSION, _digest, read_baseline
from planetary_twin_py.following.teeth.hunting_blocks import BINS
from planetary_twin_py.following.train import followed_train
from planetary_twin_py.following.vibration.growth import LearnedBaseline

SCENE = pt.load_scene("paper")


@pytest.fixture(scope="module")
def sound():
    """Arrays of a file with a baseline of the teeth and one of the vibration, by name."""
    train, many, patterns = followed_train(SCENE), 8, 6
    cell = Baseline(63.0, 104.0, 1, many)
    cell.mean = np.zeros((train.hunting_cycles, BINS))
    cell.known = np.ones(cell.mean.shape, dtype=bool)
    cell.sd, cell.slope = np.ones(len(train.teeth)), cell.mean
    teeth = {f"teeth/0/{name}": value for name, value in cell.fields().items()}
    amplitudes, each = np.full((many, 1, patterns), np.nan), np.ones(many)
    vibration = {
        "torque": np.array(63.0), "speed": np.array(104.0), "highest": np.array(4.0), "begin": each,
        "found": amplitudes, "floor": amplitudes, "each_torque": each, "each_speed": each,
    }  # fmt: skip
    about = {
        "version": VERSION, "scene": _digest(SCENE),
        "teeth": {"cells": 1, "counts_per_turn": [9, 9], "period": 1e-4},
        "vibration_0": {"cells": 1, "names": ["x"], "period": 1e-4},
    }  # fmt: skip
    return (
        {"about": np.array(json.dumps(about)), "teeth/blocks": np.zeros((many, 3))}
        | teeth
        | {f"vibration_0/0/{name}": value for name, value in vibration.items()}
    )


def loaded(path, arrays):
    np.savez(path, **arrays)
    saved = read_baseline(path, SCENE)
    Baseline.of_fields(saved.teeth.cells[0], 1)
    LearnedBaseline.of_fields(saved.vibration[0].cells[0])


PARTS = {"teeth": "teeth", "vibration": "vibration_0"}
NAMES = [f"{PARTS[kind]}/0/{name}" for kind, fields in FIELDS.items() for name in fields]


@pytest.mark.parametrize("name", ["teeth/blocks", *NAMES])
def test_a_field_that_is_missing_is_named(tmp_path, sound, name):
    loaded(tmp_path / "sound.npz", sound)
    arrays = {key: value for key, value in sound.items() if key != name}
    with pytest.raises(ValueError, match=rf"b.npz: {name}: missing$"):
        loaded(tmp_path / "b.npz", arrays)
