"""Temperatures of the core against closed forms and another method."""

import math

import numpy as np
import pytest
from scipy.linalg import expm

from planetary_twin_py import _core

NODES, HEATS = _core.NODES, _core.HEATS
AMBIENT = 290.0


def network(capacity=(4000.0, 120.0, 900.0, 2500.0, 9000.0), to_air=7.0, seed=1, **fields):
    """A network with conductances by chance, half of the pairs connected."""
    chance = np.random.default_rng(seed)
    upper = np.triu(chance.uniform(0.5, 60.0, (NODES, NODES)) * chance.integers(0, 2, (5, 5)), 1)
    upper[0, 1:] += 5.0
    given = {
        "capacity": capacity, "conductance": upper + upper.T, "ambient": AMBIENT,
        "share": chance.dirichlet(np.ones(NODES), HEATS), "area": 1.0, "to_ambient": to_air,
        "temperature": chance.uniform(280.0, 350.0, NODES), "height": 0.3, "emissivity": 0.9,
    }  # fmt: skip
    return _core.Network(**(given | fields))


def exact(net, power, duration):
    """Temperatures by the exponential of a matrix that holds the inflow as one more state."""
    rates = np.array(net.conductance) - np.diag(np.sum(net.conductance, axis=1))
    rates[4, 4] -= net.to_ambient
    inflow = power @ net.share
    inflow[4] += net.to_ambient * AMBIENT
    matrix = np.zeros((NODES + 1, NODES + 1))
    matrix[:NODES, :NODES] = rates / net.capacity[:, None]
    matrix[:NODES, NODES] = inflow / net.capacity
    return (expm(matrix * duration) @ np.append(net.temperature, 1.0))[:NODES]


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("duration", [1e-3, 1.0, 30.0, 4000.0])
def test_a_step_is_the_exponential_of_the_network(seed, duration):
    net, power = network(seed=seed), np.array([80.0, 30.0, 12.0, 5.0, 40.0])
    expected = exact(net, power, duration)
    _core.advance_network(net, power * duration, duration)
    assert net.temperature == pytest.approx(expected, rel=0, abs=1e-6)


def test_three_parts_alone_have_their_exponentials():
    apart = np.zeros((NODES, NODES))
    apart[0, 1] = apart[1, 0] = 9.0
    apart[0, 4] = apart[4, 0] = 3.0
    net = network(conductance=apart, share=np.eye(NODES)[[0, 1, 4, 0, 1]])
    power = np.array([20.0, 70.0, 1.0, 0.0, 0.0])
    for duration in (0.1, 7.0, 100.0, 2000.0):
        expected = exact(net, power, duration)
        _core.advance_network(net, power * duration, duration)
        assert net.temperature == pytest.approx(expected, rel=0, abs=1e-6)


def test_many_short_steps_are_one_long_step():
    one, many, power = network(), network(), np.array([80.0, 30.0, 12.0, 5.0, 40.0])
    _core.advance_network(one, power * 600.0, 600.0)
    for _ in range(6000):
        _core.advance_network(many, power * 0.1, 0.1)
    assert many.temperature == pytest.approx(np.array(one.temperature), rel=0, abs=1e-9)


@pytest.mark.parametrize("to_air", [7.0, 0.0])
def test_energy_of_an_hour_is_stored_released_or_cooled(to_air):
    net = network(to_air=to_air, cooling=15.0, opens=300.0)
    power, before = np.array([800.0, 300.0, 120.0, 50.0, 400.0]), net.temperature.copy()
    for _ in range(36000):
        _core.advance_network(net, power * 0.1, 0.1)
    stored = float(net.capacity @ (net.temperature - before))
    given = power.sum() * 3600.0
    assert net.cooled > 0.1 * given
    assert stored + net.released + net.cooled == pytest.approx(given, rel=1e-9)


def test_the_steady_rise_of_the_housing_is_power_over_conductance():
    net, power = network(), np.array([80.0, 30.0, 12.0, 5.0, 40.0])
    for _ in range(50):
        _core.advance_network(net, power * 5000.0, 5000.0)
    assert net.temperature[4] - AMBIENT == pytest.approx(power.sum() / 7.0, rel=1e-9)


def test_free_convection_is_that_of_incropera_example_9_2():
    # Plate of 0.71 m at 232 degC in air of 23 degC; the book rounds its film temperature to 400 K.
    rayleigh, nusselt, coefficient = _core.free_convection(505.15, 296.15, 0.71)
    assert rayleigh == pytest.approx(1.813e9, rel=0.01)
    assert nusselt == pytest.approx(147.1, rel=0.005)
    assert coefficient == pytest.approx(7.00, rel=0.005)
    assert coefficient * 1.02 * 0.71 * 209.0 == pytest.approx(1060.0, rel=0.005)


def test_churchill_and_chu_at_the_printed_numbers():
    # At a mean temperature of exactly 400 K the properties are those of the table.
    rayleigh, nusselt, _ = _core.free_convection(504.5, 295.5, 0.71)
    assert rayleigh == pytest.approx(1.813e9, rel=2e-3)
    printed = 0.825 + 0.387 * rayleigh ** (1 / 6) / (1 + (0.492 / 0.690) ** (9 / 16)) ** (8 / 27)
    assert nusselt == pytest.approx(printed**2, rel=1e-3)


def test_radiation_is_the_difference_of_fourth_powers():
    wall, air = 350.0, 290.0
    exact_one = 0.9 * 5.670374e-8 * (wall**4 - air**4)
    assert _core.radiation(wall, air, 0.9) * (wall - air) == pytest.approx(exact_one, rel=1e-12)


@pytest.mark.parametrize(("wall", "total"), [(313.15, 10.8), (333.15, 12.4), (373.15, 14.8)])
def test_still_air_takes_what_a_small_housing_gives(wall, total):
    net = network(to_air=0.0, height=0.1, ambient=293.15)
    net.temperature[4] = wall
    assert _core.to_ambient_air(net) == pytest.approx(total, rel=0.01)


def test_a_wall_as_warm_as_the_air_gives_nothing():
    net = network(to_air=0.0, temperature=np.full(NODES, AMBIENT))
    _core.advance_network(net, np.zeros(HEATS), 100.0)
    assert math.isfinite(net.released)
    assert net.temperature == pytest.approx(AMBIENT, abs=1e-9)
