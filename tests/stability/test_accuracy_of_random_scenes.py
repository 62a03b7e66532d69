"""DTE and loss of any scene keep to ten tolerances, or the run says that they do not."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

import planetary_twin_py as pt

ROOT = Path(__file__).parents[2]
TOLERANCE = 1e-4
FEW, MANY = 10, 75  # scenes of a seed


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
    [(1, FEW), *(pytest.param(seed, MANY, marks=pytest.mark.exhaustive) for seed in (2, 3, 4, 5))],
)
def test_errors_keep_to_ten_tolerances_or_the_run_warns_and_every_ledger_closes(seed, count):
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
