"""Bending of the rim of a ring, against other solutions of the same ring."""

import math

import numpy as np
import pytest
from planetary_twin_py.sensors.flexible_ring import modal_mass, natural_frequency, radial_paths

from planetary_twin_py.scene.sensors import FlexibleRing
from planetary_twin_py.sensors.filters import sampled, unchanged

RIM = FlexibleRing(law="flexible", radius=0.0317, area=120e-6, second_moment=360e-12)


def finite_elements(count=240):
    """Natural frequencies of the same ring of straight beams, without rigid motion [Hz]."""
    length = 2.0 * RIM.radius * math.sin(math.pi / count)
    e, rho, a, i = RIM.youngs_modulus, RIM.density, RIM.area, RIM.second_moment
    axial, bend = e * a / length, e * i / length**3
    k = np.zeros((6, 6))
    k[np.ix_([0, 3], [0, 3])] = axial * np.array([[1, -1], [-1, 1]])
    b = [1, 2, 4, 5]
    k[np.ix_(b, b)] = bend * np.array([
        [12, 6 * length, -12, 6 * length],
        [6 * length, 4 * length**2, -6 * length, 2 * length**2],
        [-12, -6 * length, 12, -6 * length],
        [6 * length, 2 * length**2, -6 * length, 4 * length**2],
    ])  # fmt: skip
    stiffness, mass = np.zeros((3 * count, 3 * count)), np.zeros(3 * count)
    for n in range(count):
        turn = math.tau * (n + 0.5) / count + 0.5 * math.pi
        c, s = math.cos(turn), math.sin(turn)
        one = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
        rotation = np.kron(np.eye(2), one)
        at = [3 * n + j for j in range(3)] + [3 * ((n + 1) % count) + j for j in range(3)]
        stiffness[np.ix_(at, at)] += rotation.T @ k @ rotation
        mass[at] += (
            0.5 * rho * a * length * np.array([1, 1, length**2 / 210, 1, 1, length**2 / 210])
        )
    root = np.sqrt(mass)
    values = np.linalg.eigvalsh(stiffness / np.outer(root, root))
    return np.sqrt(np.maximum(values, 0.0)) / math.tau


def test_frequencies_are_those_of_finite_elements():
    """Within 0.6 %: the beams can also extend, which the thin ring cannot."""
    found = finite_elements()[3:9:2]
    expected = [natural_frequency(RIM, m) / math.tau for m in (2, 3, 4)]
    assert found == pytest.approx(expected, rel=6e-3)


def test_unit_loads_deflect_as_the_static_series():
    """Three radial loads: bending of a ring under three equal forces (Timoshenko 1930, art. 80)."""
    series = sum(
        3.0 / (modal_mass(RIM, m) * natural_frequency(RIM, m) ** 2) for m in range(3, 400, 3)
    )
    angle = math.pi / 3.0
    radial = (RIM.radius**3 / (RIM.youngs_modulus * RIM.second_moment)) * (
        0.25 * (angle / math.sin(angle) ** 2 + 1.0 / math.tan(angle)) - 0.5 / angle
    )
    assert series == pytest.approx(radial, rel=1e-4)


def test_a_passing_planet_has_the_sidebands_of_the_modes():
    """Line l f_m + m f_c: w^2 (sin a - (i/m) cos a) / (modal mass (w_m^2 - w^2 + 2 i z w_m w))."""
    rate, turn, mesh, angle = 200_000.0, 20.0, 2000.0, math.radians(21.34)
    time = np.arange(80_000) / rate
    place, force = math.tau * turn * time, 100.0 + np.cos(math.tau * mesh * time)
    paths = radial_paths(RIM, force[:, None], place[:, None], 0.4, angle)
    values, first = sampled(paths, unchanged, 0.0, rate, 4)
    at = time[first::4][: len(values)]
    whole = len(at) // 2500 * 2500  # turns of the planet
    for m in (2, 3, 5):
        for order in (mesh - m * turn, mesh + m * turn):
            omega, own = math.tau * order, natural_frequency(RIM, m)
            gain = omega**2 * abs(math.sin(angle) - 1j / m * math.cos(angle))
            gain /= modal_mass(RIM, m) * abs(own**2 - omega**2 + 0.04j * own * omega)
            found = 2.0 * abs(np.mean(values[:whole] * np.exp(-1j * omega * at[:whole])))
            assert found == pytest.approx(0.5 * gain, rel=1e-3)
