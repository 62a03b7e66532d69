"""The oil after changes of the operating point."""

import numpy as np
import pytest

from planetary_twin_py.model.library import library, record_in
from planetary_twin_py.model.oil import build_oil
from planetary_twin_py.run.start import start
from planetary_twin_py.scene import load_scene

CHANGES = (
    {"lambda_ratio": 2.0},
    {"oil_temperature": 360.0},
    {"lambda_ratio": 0.7, "oil_temperature": 330.0},
    {"input_torque": 20.0},
    {"lambda_ratio": 1.3},
)


@pytest.mark.parametrize("name", ["paper", "wind_turbine_stage"])
def test_changes_lead_to_the_oil_of_a_scene_that_starts_there(name):
    scene = load_scene(name)
    engine, point = start(scene, 1e-3), scene.operating_point
    for changes in CHANGES:
        point = scene.point_with(point, changes)
        engine.change(point, 1e-3, 0.0)
        expected = record_in(library(scene), build_oil(scene, point))
        assert np.array_equal(engine.model.oil.raw(), expected.raw())
