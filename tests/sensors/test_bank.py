"""All sensors of a scene: the same readings whatever is fed at once, and the rate they need."""

import itertools

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.model.layout import Layout
from planetary_twin_py.sensors.bank import SensorBank
from planetary_twin_py.sensors.noise import Noise
from planetary_twin_py.sensors.remarks import alias_remarks
from planetary_twin_py.sensors.sensed import joined_readings
from sensors.prescribed import moving, read, scene_with, turning

RIM = {"law": "flexible", "radius": 0.0317, "area": 120e-6, "second_moment": 360e-12}
SENSORS = (
    {
        "kind": "accelerometer",
        "oversampling": 4,
        "noise": 0.05,
        "resonance": "12 kHz",
        "high_pass": "2 Hz",
    },
    {
        "kind": "accelerometer",
        "oversampling": 4,
        "noise": 0.05,
        "path": {"law": "resolved"},
        "range": 10.0,
    },
    {"kind": "accelerometer", "oversampling": 4, "noise": 0.05, "path": {"law": "rigid"}},
    {"kind": "accelerometer", "oversampling": 4, "noise": 0.05, "path": RIM},
    {"kind": "encoder", "lines": 1024, "noise": 1e-6, "eccentricity": 1e-6, "radius": 0.02},
    {"kind": "tachometer", "shaft": "carrier", "pulses": 60, "noise": 1e-7},
    {"kind": "torque", "noise": 0.1},
    {"kind": "proximity", "body": "sun", "noise": 1e-7},
)


@pytest.fixture(scope="module")
def scene():
    return moving(*SENSORS)


@pytest.fixture(scope="module")
def sensed(scene):
    """Noise in everything that vibrates, in 0.2 s."""
    chance = np.random.default_rng(7)
    time = np.arange(20_480) / SensorBank(Layout(scene)).rate
    count = len(time)
    return turning(
        scene, time, 20.0,
        mesh_force=300.0 + 100.0 * chance.standard_normal((count, 6)),
        torque=60.0 + chance.standard_normal((count, 2)),
        displacement=1e-6 * chance.standard_normal((count, 6, 2)),
    )  # fmt: skip


@pytest.fixture(scope="module")
def whole(scene, sensed):
    return read(scene, sensed)


def same(one, other):
    own, others = (each._replace(values=0, aliases=0.0) for each in (one, other))
    return own == others and np.array_equal(one.values, other.values)


@pytest.mark.parametrize(
    "cuts",
    [range(1000, 20_480, 1000), range(1, 20_480, 37), (1, 2, 3, 2048, 20_479), (2048, 4096)],
    ids=["equal", "short", "ragged", "blocks"],
)
def test_windows_do_not_change_a_bit(scene, sensed, whole, cuts):
    parted = read(scene, sensed, cuts)
    assert all(map(same, whole, parted))
    assert all(len(readings.values) for readings in whole) and whole[1].clipped > 0


def test_a_longer_run_begins_as_a_shorter_one(scene, sensed, whole):
    shorter = read(scene, sensed.part(0, 15_001))
    for short, long in zip(shorter, whole, strict=True):
        assert 0 < len(short.values) < len(long.values)
        assert np.array_equal(short.values, long.values[: len(short.values)])


def test_readings_are_complete_within_a_block(scene, sensed):
    """A live twin shows them 20 ms and half of a filter later."""
    bank = SensorBank(Layout(scene))
    parts = [bank.feed(sensed.part(n, n + 1024)) for n in range(0, 20_480, 1024)]
    for n, kind in ((0, "accelerometer"), (6, "torque"), (4, "encoder")):
        found = joined_readings([part[n] for part in parts])
        assert found.kind == kind
        assert found.time[-1] > 0.2 - 0.02 - 0.005


def test_one_sensor_reads_as_beside_others(scene, sensed, whole):
    """At the same rate of samples: the noise of a sensor is its own."""
    for n in (0, 4):
        bank = SensorBank(Layout(scene), [scene.sensors[n]], SensorBank(Layout(scene)).rate)
        alone = joined_readings([*bank.feed(sensed), *bank.end()])
        assert same(alone, whole[n])


@pytest.mark.parametrize(
    "sensors, rate",
    [
        ([{"kind": "accelerometer", "rate": 25_600.0}], 409_600.0),
        ([{"kind": "accelerometer", "rate": 25_600.0, "oversampling": 4}], 102_400.0),
        ([{"kind": "accelerometer", "rate": 12_500.0}, {"kind": "torque"}], 800_000.0),
        ([{"kind": "encoder", "bits": 20, "rate": 20_000.0}], 20_000.0),
        ([{"kind": "tachometer"}], 10_000.0),
        ([{"kind": "tachometer"}, {"kind": "thermometer", "rate": 3.0}], 10_002.0),
        ([{"kind": "torque", "rate": 1000.5}], 4002.0),
        ([{"kind": "torque", "rate": 0.75}, {"kind": "thermometer", "rate": 0.5}], 3.0),
    ],
)
def test_the_rate_is_a_multiple_of_those_of_all_sensors(sensors, rate):
    assert SensorBank(Layout(scene_with(*sensors))).rate == rate


def test_a_common_rate_above_2_mhz_is_refused():
    with pytest.raises(pt.SceneError) as error:
        scene_with({"kind": "torque", "rate": 25_600.0}, {"kind": "torque", "rate": 19_900.0})
    assert str(error.value) == (
        "sensors: their rates, 25600, 19900 Hz, require a common rate of 5094400 Hz: must be at "
        "most 2e+06 Hz; choose rates that divide each other, or less oversampling"
    )


def test_noise_is_normal_and_belongs_to_a_sample():
    noise = Noise(3, "ring")
    whole = noise.at(0, 5000)
    assert np.array_equal(whole[1000:1100], noise.at(1000, 100))
    assert np.array_equal(whole[3000:], Noise(3, "ring").at(3000, 2000))
    assert abs(whole.mean()) < 0.05 and np.std(whole) == pytest.approx(1.0, abs=0.03)
    for other in (Noise(4, "ring"), Noise(3, "top")):
        assert abs(np.corrcoef(whole, other.at(0, 5000))[0, 1]) < 0.05


def test_aliases_of_an_endless_run_are_estimated_once():
    """Of a force that jumps, whose lines decrease as slowly as any."""
    held = scene_with({"kind": "accelerometer", "oversampling": 4, "noise": 0.0})
    bank = SensorBank(Layout(held), endless=True)
    time = np.arange(round(1.2 * bank.rate)) / bank.rate
    jumps = np.sign(np.sin(2.0 * np.pi * 507.0 * time))
    force = np.repeat(300.0 + 100.0 * jumps[:, None], 6, axis=1)
    sensed = turning(held, time, 20.0, mesh_force=force)
    parts = np.linspace(0, len(time), 41).astype(int)
    found = [bank.feed(sensed.part(*pair))[0] for pair in itertools.pairwise(parts)]
    shares = [one.aliases for one in found if one.aliases]
    assert len(shares) == 1 and shares[0] > 1e-4
    assert len(list(alias_remarks(found[0]._replace(aliases=shares[0])))) == 1
