"""Steady temperatures of scenes with several states, and starts in them."""

import pytest

from planetary_twin_py import Twin, load_scene
from planetary_twin_py.run.steady_temperatures import SteadyTemperatures, with_start
from planetary_twin_py.scene import SceneError

PARTS = ("oil", "sun", "planets", "ring", "housing")


def steep(start="ambient"):
    """A scene whose friction jumps as the film becomes thin, so that heat feeds on itself."""
    return load_scene("paper").replace(
        dynamics="quasi_static",
        lubrication=load_scene("paper").lubrication.model_dump()
        | {
            "lambda_ratio": "computed",
            "traction": "table",
            "friction_table": {
                "lambda_ratio": [0.3, 0.38, 0.46, 0.6], "coefficient": [0.08, 0.08, 0.02, 0.02],
            },
        },
        thermal={
            "ambient": 298.15,
            "oil": {"mass": 2e-3},
            "gears": {"to_oil": 3000.0, "sun_mass": 4e-3, "ring_mass": 4e-3},
            "housing": {
                "mass": 4e-3, "area": 0.1, "height": 0.2, "from_oil": 10.0, "to_ambient": 10.0,
            },
            "dead_band": 0.5,
            "start": start,
        },
        **{"gearset.planet_mass": 2e-3},
    )  # fmt: skip


def test_steep_friction_has_three_steady_states_the_middle_one_unstable():
    states = SteadyTemperatures(steep()).states
    assert [state.stable for state in states] == [True, False, True]
    cold, middle, hot = states
    assert middle.gain > 1.0 > max(cold.gain, hot.gain)
    assert min(middle.time_constants) < 0.0
    assert hot.loss > 2.0 * cold.loss


def test_runs_beside_the_middle_state_end_in_the_stable_ones():
    cold, middle, hot = SteadyTemperatures(steep()).states
    for offset, expected in ((-6.0, cold), (6.0, hot)):
        start = {part: middle.temperatures[part] + offset for part in PARTS}
        twin = Twin(steep(start), sample_rate=10.0)
        for _ in range(60):
            oil = twin.advance(2.0).temperatures["oil"]
            if abs(oil - expected.temperatures["oil"]) < 1.5:
                break
        assert oil == pytest.approx(expected.temperatures["oil"], abs=1.5)


def test_a_steady_start_needs_one_stable_state():
    with pytest.raises(SceneError, match=r"thermal.start = 'steady': 2 steady states"):
        with_start(steep("steady"))


def test_without_the_section_there_are_no_steady_temperatures():
    with pytest.raises(SceneError, match="thermal: missing"):
        SteadyTemperatures(load_scene("paper"))
