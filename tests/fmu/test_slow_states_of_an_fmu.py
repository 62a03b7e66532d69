"""Temperatures and damage of an FMU are those of a twin."""

import numpy as np
import pytest
from fmu.importer import Refused
from fmu.test_steps_of_an_fmu import SHOWN, TOLERANCE, shown, slave_of
from ports.ports_of_paper import driven

import planetary_twin_py as pt
from planetary_twin_py.durability.parts import part_names
from planetary_twin_py.scene.thermal import NODES

THERMAL = {  # light parts, which warm within seconds
    "ambient": 300.0,
    "oil": {"mass": 0.01},
    "gears": {"to_oil": 2000.0, "sun_mass": 0.02, "ring_mass": 0.02},
    "housing": {"mass": 0.05, "area": 0.1, "height": 0.2, "from_oil": 10.0},
}
DURABILITY = {
    "bearings": {"planet": {"rating": 5e3, "kind": "roller"}},
    "shafts": {"input": {"range": 100.0, "exponent": 5.0, "reference_cycles": 1e3}},
}
TEMPERATURES = [f"temperature.{node}" for node in NODES]


def warm(**changes):
    given = {"lubrication.lambda_ratio": "computed", "thermal": THERMAL} | changes
    return driven("torque", "motion", **given)


def temperatures(twin):
    return [twin.temperatures[node] for node in NODES]


def test_temperatures_have_the_bits_of_a_twin_in_python(tmp_path):
    slave, twin = slave_of(warm(), tmp_path), pt.Twin(warm(), tolerance=TOLERANCE)
    for n in range(60):
        if n == 30:
            slave.set(operating_point__ambient_temperature=280.0)
            twin.set(ambient_temperature=280.0)
        torque = 60.0 + n % 5
        slave.set(input__torque=torque)
        slave.step(0.03)
        assert slave.get(*SHOWN) == shown(twin.step(0.03, input_torque=torque))
        assert slave.get(*TEMPERATURES) == temperatures(twin)
    assert temperatures(twin)[0] > 300.1


def test_a_steady_start_is_exported_as_temperatures(tmp_path):
    scene = warm(thermal=THERMAL | {"start": "steady"})
    slave, twin = slave_of(scene, tmp_path), pt.Twin(scene)
    assert slave.get(*TEMPERATURES) == temperatures(twin)
    assert temperatures(twin)[0] > 301.0


# windows take heat each 0.05 s, an FMU at the end of the step in which it is due
@pytest.mark.parametrize(("thermal", "step"), [(None, 0.02), (THERMAL, 0.025)])
def test_damage_is_that_of_the_windows_of_a_twin(tmp_path, thermal, step):
    scene = warm(durability=DURABILITY, thermal=thermal)
    slave, twin = slave_of(scene, tmp_path), pt.Twin(scene, 1000.0, TOLERANCE)
    parts, total = part_names(scene), 0.0
    for n in range(40):
        torque = 60.0 + 30.0 * (n % 4)
        slave.set(input__torque=torque)
        slave.step(step)
        total = total + twin.advance(step, input_torque=torque).damage.damage
    found = dict(zip(parts, slave.get(*(f"damage.{part}" for part in parts)), strict=True))
    for part, damage in zip(parts, total, strict=True):
        assert found[part] == pytest.approx(damage, rel=1e-12)
    assert all(found[part] > 0.0 for part in ("planet_2_bearing", "input_shaft"))


def test_a_state_holds_temperatures_and_damage(tmp_path):
    scene = warm(durability=DURABILITY)
    slave, names = slave_of(scene, tmp_path), ["damage.planet_1_bearing", *TEMPERATURES]

    def future():
        for _ in range(10):
            slave.step(0.05)
        return slave.get(*names)

    slave.step(0.2)
    before, state = slave.get(*names), slave.state()
    first = future()
    assert all(value > old for value, old in zip(first, before, strict=True))
    slave.restore(state)
    assert slave.get(*names) == before
    assert future() == first
    slave.free(state)
    slave.reset()
    slave.begin()
    assert slave.get(*names) == [0.0] + [300.0] * len(NODES)


def test_a_part_that_is_too_hot_ends_the_fmu_in_one_line(tmp_path):
    hot = dict.fromkeys(NODES, 473.1) | {"sun": 473.15}
    slave = slave_of(warm(thermal=THERMAL | {"start": hot}, input_speed=300.0), tmp_path)
    with pytest.raises(Refused, match=r"a part of 47.* K leaves the range 233\.15 to 473\.15 K"):
        for _ in range(100):
            slave.step(0.1)


@pytest.mark.parametrize("version", ["3.0", "2.0"])
def test_seven_planets_have_room_for_every_variable(tmp_path, version):
    sizes = {
        "gearset.planet_angles": np.linspace(0.0, 2.0 * np.pi, 7, endpoint=False).tolist(),
        "gearset.teeth": {"sun": 100, "planet": 26, "ring": 152},
    }
    scene = warm(durability=DURABILITY, **sizes)
    pt.export_fmu(scene, tmp_path / "gearbox.fmu", version=version)
