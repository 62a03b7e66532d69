"""Bending of the rim of a ring, against other solutions of the same ring."""

import math

import numpy as np
import pytest

from planetary_twin_py.scene.sensors import FlexibleRing
from planetary_twin_py.sensors.flexible_path import modal_mass, natural_frequency
from sensors.prescribed import line, read, scene_with, turning

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


@pytest.mark.parametrize("direction", ["radial", "tangential"])
def test_a_passing_planet_has_the_sidebands_of_the_modes(direction):
    """Line l f_m + m f_c: w^2 (sin a - (i/m) cos a) / (modal mass (w_m^2 - w^2 + 2 i z w_m w)).

    The tangential displacement of a mode is 1/m of its radial one.
    """
    rate, turn, mesh = 50_000.0, 20.0, 2000.0
    path = {"law": "flexible", **RIM.model_dump(include={"radius", "area", "second_moment"})}
    sensor = {"kind": "accelerometer", "rate": rate, "angle": 0.4, "oversampling": 4, "path": path}
    scene = scene_with({**sensor, "direction": direction})
    angle = scene.gearset.geometry.meshes[1].pressure_angle
    time = np.arange(160_000) / (4.0 * rate)
    force = np.zeros((len(time), 6))
    force[:, 3] = 100.0 + np.cos(math.tau * mesh * time)  # one planet alone
    sensed = turning(scene, time, math.tau * turn, mesh_force=force)
    (readings,) = read(scene, sensed)
    for m in (2, 3, 5):
        for order in (mesh - m * turn, mesh + m * turn):
            omega, own = math.tau * order, natural_frequency(RIM, m)
            gain = omega**2 * abs(math.sin(angle) - 1j / m * math.cos(angle))
            gain /= modal_mass(RIM, m) * abs(own**2 - omega**2 + 0.04j * own * omega)
            gain /= m if direction == "tangential" else 1
            found = abs(line(readings.values, rate, order))
            assert found == pytest.approx(0.5 * gain, rel=1e-3)
