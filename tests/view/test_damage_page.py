"""Damage of the parts beside the gears: bars at the time cursor and curves."""

import warnings

import numpy as np
import pytest
from following.power_map import PARTS, SCENE
from view.entity_rows import rows

from planetary_twin_py.recording.runs.offline import NAMESPACE, Plan, record
from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.recording.runs.slow_states import read_damage
from planetary_twin_py.view.show import save


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    place = tmp_path_factory.mktemp("aging") / "run.mcap"
    return read_recording(record(Plan(SCENE, 3.0, 1000.0, 1e-3), place))


def test_bars_and_curves_are_the_recorded_sums(recording, tmp_path):
    rrd = tmp_path / "aging.rrd"
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        save(recording, SCENE, rrd)
    aged = read_damage(recording.path, NAMESPACE, recording.topics)
    curves = rows(rrd, "/damage/parts")
    bars = rows(rrd, "/damage/bars", "BarChart:values")
    assert [time for time, _ in curves] == pytest.approx([1.0, 2.0, 3.0])
    assert np.array([row for _, row in curves]) == pytest.approx(aged.values)
    drawn = np.array([row[0]["buffer"] for _, row in bars])
    assert drawn == pytest.approx(aged.values) and drawn.shape == (3, len(PARTS))
