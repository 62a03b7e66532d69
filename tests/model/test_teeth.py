"""Teeth that scenes share: what shapes them, and how often they are built."""

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.model import teeth
from planetary_twin_py.simulation.threads import Threads
from planetary_twin_py.studies.axes import Axis
from planetary_twin_py.studies.plan import Settings, grid
from planetary_twin_py.studies.sweep import sweep

RELIEF = {"mesh.tip_relief.sun": {"amount": 1e-5, "length": 2e-3}}
PAPER = pt.load_scene("paper")
SCENES = {"paper": PAPER, "relief": PAPER.replace(**RELIEF)}


@pytest.fixture
def builds():
    """Number of builds of teeth, from none kept, also not in trains."""
    teeth.tables_of.cache_clear()
    return lambda: teeth.tables_of.cache_info().misses


@pytest.mark.parametrize(("scene", "torques"), [("paper", 1), ("relief", 20)])
def test_study_builds_teeth_of_each_torque_that_they_feel_once(builds, scene, torques):
    still = SCENES[scene].replace(dynamics="quasi_static")
    axes = [Axis("input_speed", (20.0, 30.0)), Axis("input_torque", tuple(np.arange(5.0, 25.0)))]
    table = sweep(grid(still, axes, Settings(1e-3, 0.0)), Threads(1))
    assert table["failure"].null_count == 40
    assert builds() == torques
