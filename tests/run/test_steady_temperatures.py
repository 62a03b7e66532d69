"""Steady temperatures of scenes with several states, and starts in them."""

import numpy as np
import pytest

from planetary_twin_py import Twin, load_scene
from planetary_twin_py.run.steady_temperatures import SteadyTemperatures, with_start
from planetary_twin_py.scene import SceneError
from planetary_twin_py.scene.thermal import COLDEST, HOTTEST

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


def table(limits, coefficients, to_ambient):
    """A scene whose parts all have nearly the same temperature, with steps of the friction."""
    scene = steep()
    law = {"friction_table": {"lambda_ratio": limits, "coefficient": coefficients}}
    thermal = scene.thermal.model_dump()
    thermal["gears"]["to_oil"], thermal["housing"]["from_oil"] = 1e6, 1e6
    thermal["housing"]["to_ambient"] = to_ambient
    return scene.replace(thermal=thermal, lubrication=scene.lubrication.model_dump() | law)


@pytest.mark.parametrize(
    ("limits", "coefficients", "to_ambient", "count"),
    [
        ([0.3, 0.32, 0.44, 0.46, 0.7, 0.8], [0.11, 0.11, 0.05, 0.05, 0.02, 0.02], 20.0, 1),
        ([0.22, 0.26, 0.32, 0.38, 0.46, 0.6], [0.12, 0.12, 0.06, 0.06, 0.02, 0.02], 15.0, 3),
        ([0.24, 0.26, 0.5, 0.53], [0.12, 0.06, 0.06, 0.02], 14.5, 5),
    ],
)
def test_all_states_are_the_roots_of_one_equation(limits, coefficients, to_ambient, count):
    """With one temperature, P(T) = A h (T - T_ambient): its roots on a fine grid."""
    found = SteadyTemperatures(table(limits, coefficients, to_ambient))
    heat = np.linspace(COLDEST, HOTTEST, 24_001)
    kept = found.curve(np.repeat(heat[:, None], 5, axis=1)).sum(axis=1)
    kept -= 0.1 * to_ambient * (heat - 298.15)
    roots = heat[:-1][np.diff(np.sign(kept)) != 0.0]
    states = found.states
    assert len(states) == len(roots) == count
    oils = [state.temperatures["oil"] for state in states]
    np.testing.assert_allclose(oils, roots, atol=0.1)
    assert [state.stable for state in states] == [n % 2 == 0 for n in range(count)]


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
