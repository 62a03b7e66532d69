"""DTE and loss of any scene keep to ten tolerances, or the run says that they do not."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

import planetary_twin_py as pt

ROOT = Path(__file__).parents[2]
TOLERANCE = 1e-4
FEW, SOME, MANY = 5, 10, 75  # scenes of a seed


def _benchmark():
    """The script that draws scenes and measures their errors."""
    place = ROOT / "benchmarks" / "random_scenes.py"
    spec = importlib.util.spec_from_file_location("random_scenes", place)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize(
    ("seed", "count"),
    [
        (6, FEW),
        pytest.param(1, SOME, marks=pytest.mark.exhaustive),
        *(pytest.param(seed, MANY, marks=pytest.mark.release) for seed in (2, 3, 4, 5)),
    ],
)
def test_errors_keep_to_ten_tolerances_and_ledgers_close(seed, count):
    script = _benchmark()
    random, paper = np.random.default_rng(seed), pt.load_scene("paper")
    compared, silent, open_ledgers = 0, [], []
    for number in range(count):
        changes = script.random_changes(random)
        try:
            found = script.measure(paper.replace(**changes), TOLERANCE)
        except (ValueError, pt.RunawayError):
            continue
        compared += 1
        if not found.within(TOLERANCE) and not found.warnings:
            silent.append((number, found))
        if not found.closed:
            open_ledgers.append((number, found))
    assert compared > 0.9 * count
    assert silent == []
    assert open_ledgers == []


@pytest.mark.release
@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("seed", range(101, 131))
def test_figures_of_any_scene_keep_to_ten_tolerances(seed):
    """Ten scenes of any dynamics and ports, and differentials, against a reference at 1e-7."""
    script, random, silent, compared = _benchmark(), np.random.default_rng(seed), [], 0
    for number in range(10):
        try:
            errors, warned = script.compare_printed(script.any_scene(random), TOLERANCE)
        except (ValueError, pt.RunawayError):
            continue
        compared += 1
        beyond = {name: error for name, error in errors.items() if not error < 10.0}
        if beyond and not warned:
            silent.append((number, beyond))
    assert compared >= 3
    assert silent == []
