"""Readings of windows and results."""

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.run.readings import by_sensor
from planetary_twin_py.sensors.sensed import Readings

SENSORS = [
    {"name": "top", "kind": "accelerometer", "resonance": 30e3, "range": 500.0},
    {"name": "encoder", "kind": "encoder", "shaft": "input", "lines": 1024},
    {"name": "key", "kind": "tachometer", "shaft": "output"},
    {"name": "torque", "kind": "torque"},
    {"name": "oil", "kind": "thermometer", "rate": 100.0},
]
MOVING = [{"name": "sun", "kind": "proximity", "body": "sun", "angle": 0.5}]
PAPER = pt.load_scene("paper").replace(sensors=SENSORS)
PLANAR = pt.load_scene("floating_sun").replace(sensors=[*SENSORS, *MOVING])


def read(scene: pt.Scene, *windows: float, rates: tuple[float, ...] = (50_000.0,)) -> dict:
    """Readings of windows of these lengths, with these sample rates of the waveform in turn."""
    twin, parts = pt.Twin(scene, rates[0], 1e-3), list[Readings]()
    for number, length in enumerate(windows):
        twin.set_sample_rate(rates[number % len(rates)])
        parts += twin.advance(length).sensors.values()
    return by_sensor(parts)


def assert_same(found: dict, expected: dict) -> None:
    assert found.keys() == expected.keys()
    for name, readings in expected.items():
        assert found[name].first == readings.first or not len(readings.values), name
        assert np.array_equal(found[name].values, readings.values), name


@pytest.mark.parametrize(
    ("scene", "count"), [(PAPER, 370), (PLANAR, 60)], ids=["torsional", "planar"]
)
def test_readings_do_not_depend_on_windows_or_waveform(scene: pt.Scene, count: int) -> None:
    """Windows of 1 ms, 10 ms, and one; also with a waveform that is thinned, as under overload."""
    whole = read(scene, count / 1000.0)
    assert all(len(readings.values) for name, readings in whole.items() if name != "key")
    assert_same(read(scene, *[0.001] * count), whole)
    assert_same(read(scene, *[0.01] * (count // 10), rates=(50_000.0, 6250.0, 1000.0)), whole)


def test_twins_and_a_twin_have_the_same_readings() -> None:
    scenes = [PAPER, pt.load_scene("paper"), PAPER.replace(lambda_ratio=1.5)]
    found = [list[Readings]() for _ in scenes]
    twins = pt.Twins(scenes, 50_000.0, 1e-3, workers=2)
    for _ in range(5):
        for parts, window in zip(found, twins.advance(0.02), strict=True):
            assert window is not None
            parts += window.sensors.values()
    for scene, parts in zip(scenes, found, strict=True):
        assert_same(by_sensor(parts), read(scene, *[0.02] * 5))


@pytest.mark.parametrize("scene", [PAPER, PLANAR], ids=["torsional", "planar"])
def test_readings_of_a_result_are_those_of_a_twin(scene: pt.Scene) -> None:
    """Those after settling; the result also has what still waits in a twin."""
    result = pt.simulate(scene, 0.06, 1000.0, tolerance=1e-3, settling=0.06)
    for name, whole in read(scene, 0.12).items():
        found = result.sensors[name]
        expected = whole.values[whole.time > 0.06 + 1e-9]
        assert len(expected) <= len(found.values), name
        assert np.array_equal(found.values[: len(expected)], expected), name
        assert found.time[0] > 0.06, name


def test_readings_continue_through_changes_of_the_operating_point() -> None:
    twin, parts = pt.Twin(PAPER, 10_000.0, 1e-3), list[Readings]()
    for number in range(30):
        parts += twin.advance(0.01).sensors.values()
        if number == 14:
            twin.set(lambda_ratio=1.5, oil_temperature=340.0)
            twin.set_tolerance(1e-4)
    encoder = by_sensor(parts)["encoder"]
    assert np.ptp(np.diff(encoder.values)) <= 1
    assert encoder.time[-1] == pytest.approx(0.3, abs=1.5 * encoder.period)
