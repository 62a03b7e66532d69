"""Temperatures of runs: energy, windows, changes, and their time constants."""

import numpy as np
import pytest

from planetary_twin_py import Twin, load_scene, simulate
from planetary_twin_py.run.steady_temperatures import SteadyTemperatures
from planetary_twin_py.scene import SceneError

THERMAL = {  # time constants within a factor of ten, so that runs are short
    "ambient": "25 degC",
    "oil": {"mass": 0.2},
    "gears": {"to_oil": 500.0, "sun_mass": 1.0, "ring_mass": 1.0},
    "housing": {"mass": 0.5, "area": 0.1, "height": 0.2, "from_oil": 10.0, "to_ambient": 140.0},
    "dead_band": 0.02,
}
LOSSES = {
    "planet_bearing": {"mean_diameter": 0.02},
    "sun_drag": {"coulomb": 0.05},
    "churning": {"fill": 0.3, "gap": 0.01, "sun": 0.03, "carrier": 0.08},
}


def warm(base="paper", thermal=THERMAL, losses=LOSSES, **changes):
    """A scene with temperatures and every source of heat."""
    given = {"gearset.planet_mass": 0.3, "lubrication.lambda_ratio": "computed"} | changes
    return load_scene(base).replace(thermal=thermal, losses=losses, **given)


def lighter(scene, factor):
    """The scene with capacities divided by a factor."""
    thermal, gearset = scene.thermal, scene.gearset
    return scene.replace(
        **{
            "thermal.oil.mass": thermal.oil.mass / factor,
            "thermal.housing.mass": thermal.housing.mass / factor,
            "thermal.gears.sun_mass": thermal.gears.sun_mass / factor,
            "thermal.gears.ring_mass": thermal.gears.ring_mass / factor,
            "gearset.planet_mass": gearset.planet_mass / factor,
        }
    )


DYNAMICS = {
    "quasi_static": "lightly_loaded",
    "torsional": "lightly_loaded",
    "planar": "floating_sun",
}


@pytest.mark.parametrize("dynamics", DYNAMICS)
def test_heat_by_source_sums_to_the_power_loss(dynamics):
    scene = warm(DYNAMICS[dynamics], dynamics=dynamics)
    result = simulate(scene, 0.35, sample_rate=1e3)
    assert sum(result.heat.values()) == pytest.approx(result.mean_power_loss, rel=1e-12)
    assert all(heat > 0.0 for heat in result.heat.values())
    twin = Twin(scene, sample_rate=1e3)
    for duration in (0.05, 0.2, 0.013):
        window = twin.advance(duration)
        assert sum(window.heat.values()) == pytest.approx(window.power_loss, rel=1e-9)


@pytest.mark.parametrize("dynamics", DYNAMICS)
def test_temperatures_are_the_same_for_windows_of_any_length(dynamics):
    scene = lighter(warm(DYNAMICS[dynamics], dynamics=dynamics), 100.0)
    ends = []
    for windows in ([0.6], [0.1] * 6, [0.033, 0.25, 0.017, 0.3], [0.6]):
        twin = Twin(scene, sample_rate=1e3)
        for duration in windows:
            window = twin.advance(duration)
        ends.append(dict(window.temperatures) | {"dte": window.waveform.dte[-1].tolist()})
    assert ends[0]["oil"] != pytest.approx(298.15, abs=1e-4)
    assert all(end == ends[0] for end in ends[1:])


def test_a_gearbox_that_warms_from_cold_repeats_its_mesh_cycles():
    """Its losses and temperatures are those of a run in which each mesh cycle is computed."""
    runs = [simulate(warm(), 2.0, 1.0, method, 1e-3, 4.0) for method in ("auto", "march")]
    repeated, computed = runs
    assert repeated.stats.repeated_steps > 0.5 * computed.stats.steps
    assert computed.stats.repeated_steps == 0
    assert repeated.mean_power_loss == pytest.approx(computed.mean_power_loss, rel=1e-5)
    for part, exact in computed.temperatures.items():
        rise = exact - 298.15
        assert repeated.temperatures[part] - 298.15 == pytest.approx(rise, rel=1e-5)


def test_repetition_while_warming_does_not_depend_on_the_windows():
    ends = []
    for windows in ([3.05], [0.1] * 30 + [0.05], [1.033, 0.25, 0.017, 1.75]):
        twin = Twin(warm(), sample_rate=1e3)
        for duration in windows:
            window = twin.advance(duration)
        assert twin.advance(1e-3).repeated
        ends.append(dict(window.temperatures) | {"dte": window.waveform.dte[-1].tolist()})
    assert all(end == ends[0] for end in ends[1:])


def test_what_heats_the_gearbox_is_stored_or_given_away():
    twin = Twin(lighter(warm(dynamics="quasi_static"), 100.0), sample_rate=10.0)
    network = twin._windows.run.warming.network
    before, heat = network.temperature.copy(), 0.0
    for _ in range(10):
        window = twin.advance(0.5)
        heat += sum(window.heat.values()) * 0.5
    stored = float(network.capacity @ (network.temperature - before))
    assert stored + network.released == pytest.approx(heat, rel=1e-9)


def test_a_run_ends_in_the_steady_state_of_the_map():
    scene = lighter(warm(dynamics="quasi_static"), 500.0)
    (state,) = SteadyTemperatures(scene).states
    assert state.stable
    end = simulate(scene, 10.0 * state.time_constants[0], sample_rate=10.0).temperatures
    for part, value in state.temperatures.items():
        assert end[part] == pytest.approx(value, abs=0.1)


def test_vibration_warms_as_the_map_says():
    scene = lighter(warm(dynamics="torsional"), 500.0)
    (state,) = SteadyTemperatures(scene).states
    end = simulate(scene, 6.0 * state.time_constants[0], sample_rate=10.0).temperatures
    rise = state.temperatures["oil"] - end["ambient"]
    assert end["oil"] - end["ambient"] == pytest.approx(rise, rel=0.02)


def test_a_steady_start_stays():
    scene = warm(thermal=THERMAL | {"start": "steady"}, dynamics="quasi_static")
    twin = Twin(scene, sample_rate=10.0)
    before = dict(twin.temperatures)
    after = twin.advance(10.0).temperatures
    assert before["oil"] > 300.0
    assert all(after[part] == pytest.approx(before[part], abs=0.02) for part in before)


def test_small_changes_decay_with_the_time_constant_of_the_map():
    fine = THERMAL | {"dead_band": 1e-2}
    scene = lighter(warm(thermal=fine, dynamics="quasi_static"), 500.0)
    (state,) = SteadyTemperatures(scene).states
    slowest = state.time_constants[0]
    start = {part: value - 10.0 for part, value in state.temperatures.items()}
    twin = Twin(scene.replace(**{"thermal.start": start}), sample_rate=10.0)
    window = round(0.5 * slowest, 3)
    found = [twin.advance(window).temperatures["oil"] for _ in range(9)]
    gaps = np.log(state.temperatures["oil"] - np.array(found[4:]))
    measured = -window / np.polyfit(range(len(gaps)), gaps, 1)[0]
    assert measured == pytest.approx(slowest, rel=0.02)


def test_the_steady_oil_follows_the_ambient_air_as_the_map_says():
    fine = THERMAL | {"dead_band": 1e-2, "start": "steady"}
    scene = lighter(warm(thermal=fine, dynamics="quasi_static"), 500.0)
    (state,) = SteadyTemperatures(scene).states
    twin = Twin(scene, sample_rate=10.0)
    before = twin.temperatures["oil"]
    twin.set(ambient_temperature=scene.operating_point.ambient_temperature + 5.0)
    after = twin.advance(10.0).temperatures["oil"]
    assert (after - before) / 5.0 == pytest.approx(state.per_ambient, rel=0.02)


def test_the_oil_of_a_scene_with_temperatures_cannot_be_set():
    twin = Twin(warm(dynamics="quasi_static"))
    with pytest.raises(SceneError, match="oil_temperature: is a state"):
        twin.set(oil_temperature=350.0)


def test_without_losses_all_stays_at_the_ambient_temperature():
    scene = warm(losses={}, dynamics="quasi_static", **{"lubrication.friction": False})
    window = Twin(scene, sample_rate=10.0).advance(10.0)
    assert window.temperatures == dict.fromkeys(window.temperatures, 298.15)


def test_thermometers_read_the_oil():
    thermometer = {"kind": "thermometer", "name": "sump", "time_constant": 0.05, "noise": 0.0}
    scene = lighter(warm(dynamics="torsional", sensors=[thermometer]), 200.0)
    result = simulate(scene, 2.0, sample_rate=1e3)
    (readings,) = result.sensors.values()
    assert readings.values.ravel()[-1] == pytest.approx(result.temperatures["oil"], abs=1.0)
    assert readings.values.ravel()[-1] > readings.values.ravel()[0]


def test_steps_of_a_joint_warm_as_windows_do():
    scene = lighter(warm(dynamics="torsional"), 100.0)
    stepped, advanced = Twin(scene), Twin(scene)
    for _ in range(100):
        stepped.step(0.01)
    advanced.advance(1.0)
    assert stepped.temperatures == pytest.approx(dict(advanced.temperatures), abs=1e-3)


def test_oil_that_is_too_hot_ends_the_run_in_one_line():
    hot = THERMAL | {"start": dict.fromkeys(("oil", "sun", "planets", "ring", "housing"), 473.0)}
    twin = Twin(lighter(warm(thermal=hot, dynamics="quasi_static"), 500.0))
    network = twin._windows.run.warming.network
    network.temperature = np.full(5, 473.5)
    with pytest.raises(ArithmeticError, match="leaves the range"):
        twin.advance(1.0)
