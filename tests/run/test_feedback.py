"""The feedback gain of a run is that of the map at its temperatures and load."""

import math

import pytest
from run.test_warming import warm

from planetary_twin_py.run.feedback import FeedbackGain
from planetary_twin_py.run.steady_temperatures import SteadyTemperatures


@pytest.mark.parametrize("speed", [50.0, 200.0])
def test_the_gain_of_a_steady_state_is_that_of_the_map(speed):
    scene = warm()
    there = scene.replace(input_speed=speed)
    (state,) = SteadyTemperatures(there).states
    gain = FeedbackGain(scene)
    ambient = {"ambient": scene.operating_point.ambient_temperature}
    start = dict.fromkeys(state.temperatures, 300.0) | ambient
    gain(start, scene.operating_point)  # an earlier load leaves no trace
    found = gain(state.temperatures | ambient, there.operating_point)
    assert found == pytest.approx(state.gain, rel=0.02)


def test_a_gain_is_kept_while_nothing_changes_and_unknown_at_rest():
    scene = warm()
    gain, point = FeedbackGain(scene), scene.operating_point
    at = dict.fromkeys(("oil", "sun", "planets", "ring", "housing"), 320.0) | {"ambient": 298.15}
    first = gain(at, point)
    assert gain({name: value + 0.4 for name, value in at.items()}, point) == first
    assert gain({name: value + 5.0 for name, value in at.items()}, point) != first
    gain.begin()
    assert gain(at, point) == first
    assert math.isnan(gain(at, point.model_copy(update={"input_speed": 0.0})))
