"""What sensors are given: samples at a rate of their own, beside those of the waveform."""

from collections.abc import Callable, Iterator
from itertools import pairwise

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.run import sensing
from planetary_twin_py.sensors.sensed import Readings, Sensed, joined_samples

RATE = 40_000.0  # [Hz]


class Collector:
    """A bank that keeps what it is given."""

    made: list["Collector"]

    def __init__(self, layout: object, *, endless: bool) -> None:
        self.rate = RATE
        self.given: list[Sensed] = []
        Collector.made.append(self)

    def feed(self, sensed: Sensed) -> tuple[Readings, ...]:
        self.given.append(sensed)
        return ()

    def end(self) -> tuple[Readings, ...]:
        return ()


@pytest.fixture
def collected(monkeypatch: pytest.MonkeyPatch) -> Callable[[], Sensed]:
    """All samples that the newest bank was given; they follow one another."""
    Collector.made = []
    monkeypatch.setattr(sensing, "SensorBank", Collector)

    def newest() -> Sensed:
        given = Collector.made[-1].given
        for before, after in pairwise(given):
            assert after.first == before.end
        return joined_samples(given)

    return newest


def with_sensor(scene: pt.Scene) -> pt.Scene:
    return scene.replace(sensors=[{"name": "shaft", "kind": "torque"}])


def advanced(scene: pt.Scene, rate: float, *lengths: float) -> Iterator[pt.Window]:
    twin = pt.Twin(scene, rate, 1e-3)
    for length in lengths:
        yield twin.advance(length)


@pytest.mark.parametrize("name", ["paper", "differential", "floating_sun"])
def test_samples_of_sensors_are_those_of_a_waveform(
    name: str, collected: Callable[[], Sensed]
) -> None:
    """Bit for bit those that a waveform of the same rate has."""
    scene, duration = pt.load_scene(name), 0.02
    for _ in advanced(with_sensor(scene), 1000.0, duration):
        pass
    found, whole = collected(), pt.simulate(scene, duration, RATE, tolerance=1e-3)
    assert found.first == 1
    for quantity in ("angle", "speed", "mesh_force"):
        assert np.array_equal(getattr(found, quantity), getattr(whole, quantity)), quantity
    if whole.axes is None:
        assert found.displacement is None
    else:
        assert found.displacement is not None
        assert np.array_equal(found.displacement, whole.axes.displacement)


@pytest.mark.parametrize("name", ["paper", "differential", "floating_sun"])
def test_torque_in_a_shaft_and_of_its_machine_turn_the_inertia(
    name: str, collected: Callable[[], Sensed]
) -> None:
    """Euler's law of each machine between two instants: what enters, less what the shaft takes."""
    scene = with_sensor(pt.load_scene(name))
    twin = pt.Twin(scene, 1000.0, 1e-6)
    ends = [scene.drive.input, scene.drive.output]
    twin.advance(0.005)
    before = twin.port_states.copy()
    window = twin.advance(0.01)
    after, found = twin.port_states, collected()
    kept = found.torque[-round(0.01 * RATE) - 1 :]
    taken = np.trapezoid(kept, dx=1.0 / RATE, axis=0)
    speeds = [
        (after.input_speed - before.input_speed), (after.output_speed - before.output_speed)
    ]  # fmt: skip
    for machine, (end, gained) in enumerate(zip(ends, speeds, strict=True)):
        given = window.machine_torque[machine] * 0.01
        assert given - taken[machine] == pytest.approx(end.inertia * gained, abs=2e-4 * abs(given))


@pytest.mark.parametrize("name", ["paper", "floating_sun"])
@pytest.mark.parametrize("rate", [50_000.0, 7.0])
def test_sensors_change_nothing_else(name: str, rate: float) -> None:
    scene, duration = pt.load_scene(name), {"paper": 1.0, "floating_sun": 0.15}[name]
    without = pt.simulate(scene, duration, rate, settling=duration)
    beside = pt.simulate(with_sensor(scene), duration, rate, settling=duration)
    assert not without.sensors
    assert beside.stats.steps == without.stats.steps
    assert np.array_equal(beside.mesh_force, without.mesh_force)
    assert np.array_equal(beside.mean_speed, without.mean_speed)
    assert beside.energy == without.energy
    for statistic, values in without.mesh.items():
        assert np.array_equal(beside.mesh[statistic], values, equal_nan=True), statistic


def test_sensors_restart_after_steps_without_windows(
    collected: Callable[[], Sensed],
) -> None:
    """Steps have no samples: the next window has those after its start."""
    twin = pt.Twin(with_sensor(pt.load_scene("paper")), 1000.0, 1e-3)
    twin.advance(0.01)
    twin.step(0.0051)
    twin.advance(0.01)
    assert len(Collector.made) == 2
    assert collected().first == 1 + round(0.0151 * RATE)
    assert collected().end == 1 + round(0.0251 * RATE)


def test_sensors_refuse_quasi_static_dynamics() -> None:
    with pytest.raises(pt.SceneError, match=r"^sensors: .* dynamics"):
        pt.Twin(with_sensor(pt.load_scene("compact_actuator")))
