"""Temperatures of oil, gears and housing as curves."""

import numpy as np
import pytest
from view.entity_rows import rows

from planetary_twin_py import load_scene, simulate
from planetary_twin_py.recording.runs.offline import NAMESPACE, Plan, record
from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.recording.runs.slow_states import TEMPERATURES, read_thermal
from planetary_twin_py.view.show import save

SCENE = load_scene("paper").replace(
    dynamics="quasi_static",
    thermal={
        "oil": {"mass": 0.05},
        "gears": {"to_oil": 2000.0},
        "housing": {"mass": 0.4, "area": 0.1, "height": 0.2, "from_oil": 10.0},
    },
)


def test_curves_are_those_of_the_run_in_degrees_celsius(tmp_path):
    recording = read_recording(record(Plan(SCENE, 2.0, 1000.0, 1e-3), tmp_path / "run.mcap"))
    rrd = tmp_path / "warm.rrd"
    save(recording, SCENE, rrd)
    read = read_thermal(recording.path, NAMESPACE, recording.topics).temperatures
    curves = rows(rrd, "/temperatures")
    assert [time for time, _ in curves] == pytest.approx([1.0, 2.0])
    assert np.array([row for _, row in curves]) == pytest.approx(read.values - 273.15)
    end = simulate(SCENE, 2.0, 1000.0, settling=0.0).temperatures
    assert dict(zip(TEMPERATURES, read.values[-1], strict=True)) == pytest.approx(
        {name.removesuffix("s") if name == "planets" else name: end[name] for name in end}, rel=1e-6
    )
