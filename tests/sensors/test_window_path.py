"""What an accelerometer receives of planets that pass it, against lines in closed form."""

import math

import numpy as np
import pytest

from planetary_twin_py.model.layout import Layout
from planetary_twin_py.scene.sensors.paths import FilteredWindow
from planetary_twin_py.sensors.bank import SensorBank
from planetary_twin_py.sensors.path_response import path_response
from sensors.prescribed import line_of, read, scene_with, times, turning

TURN = 20.0  # of the carrier per second
RATE = 25_600.0
UNEVEN = (1.462, 0.542, 1.455, 0.541)
CASES = {  # teeth, window, loads of the planets, expected orders over the largest one
    "21/39/99": ((21, 39, 99), {}, (1, 1, 1), {99: 1.0, 96: 8 / 70, 102: 8 / 70}),
    "17/37/91": ((17, 37, 91), {}, (1, 1, 1), {90: 1.0, 93: 0.5, 87: 1 / 56, 91: 0.0}),
    "28/36/100": ((28, 36, 100), {}, (1, 1, 1, 1), {100: 1.0, 96: 1 / 70, 98: 0.0}),
    "28/36/100 uneven": (
        (28, 36, 100), {}, UNEVEN, {100: 1.0, 98: 0.18340, 102: 0.18340},
    ),
    "28/36/100 uneven, hann": (
        (28, 36, 100), {"shape": "hann"}, UNEVEN, {100: 1.0, 98: 0.38917, 102: 0.38917},
    ),
    "50/25/100, five planets": (
        (50, 25, 100), {"power": 6}, (1, 1, 1, 1, 1), {100: 1.0, 105: 12 / 924, 98: 0.0},
    ),
}  # fmt: skip


def sensor(**path):
    return {
        "kind": "accelerometer",
        "rate": RATE,
        "angle": 0.7,
        "oversampling": 4,
        "path": {"law": "window", **path},
    }


def measured(scene, force):
    """Readings of the sensor under forces of the ring meshes, a function of the places.

    They come in addition to the static ones, so that nothing decays from the start.
    """
    layout = Layout(scene)
    static = layout.mesh_force(scene.operating_point.input_torque)
    time = times(SensorBank(layout), 1.2)
    places = math.tau * TURN * time[:, None] + np.asarray(scene.gearset.planet_angles)
    ring = static + force(places)
    sensed = turning(scene, time, math.tau * TURN, mesh_force=np.hstack([0.0 * ring, ring]))
    return read(scene, sensed)[0]


@pytest.mark.parametrize("name", CASES)
def test_sidebands_follow_teeth_planets_and_loads(name):
    teeth, path, loads, expected = CASES[name]
    scene = scene_with(sensor(**path), teeth=teeth, planets=len(loads))
    readings = measured(scene, lambda places: loads * np.cos(teeth[2] * places))
    lines = {order: abs(line_of(readings, TURN * order)) for order in expected}
    largest = max(lines.values())
    for order, ratio in expected.items():
        assert lines[order] / largest == pytest.approx(ratio, abs=1e-4), order


def test_a_constant_share_adds_to_the_mesh_line_alone():
    """Of 21/39/99: N (W_0 + direct), and N W_3 beside it."""
    scene = scene_with(sensor(direct=0.3, gain=2.0))
    readings = measured(scene, lambda places: np.cos(99 * places))
    assert abs(line_of(readings, 99 * TURN)) == pytest.approx(6.0 * (70 / 256 + 0.3), rel=1e-4)
    assert abs(line_of(readings, 102 * TURN)) == pytest.approx(6.0 * 8 / 256, rel=1e-3)


def test_a_constant_load_is_not_measured():
    """Whatever the planets carry: the alternating part alone is."""
    scene = scene_with(sensor())
    assert np.abs(measured(scene, lambda places: 0.0 * places).values).max() < 1e-9


@pytest.mark.parametrize("direction", ["radial", "tangential"])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_resolved_force_has_the_sidebands_of_its_direction(direction, side):
    """One planet: order Z + m has W_(m-1) and W_(m+1), with the phase of the line of action.

    The force on the ring is F (sin a e_r - cos a e_t) on drive flanks, and (-cos a) becomes cos a
    on coast flanks; its part along the sensor is that of exp(i d) times sin a -+ i cos a.
    """
    own = {**sensor(law="resolved"), "direction": direction}
    scene = scene_with(own, input_torque=63.0 * side)
    angle = scene.gearset.geometry.meshes[1].pressure_angle
    only = np.array([1.0, 0.0, 0.0])
    readings = measured(scene, lambda places: only * np.cos(99 * places))
    window = [math.comb(8, 4 + m) / 256 if abs(m) <= 4 else 0.0 for m in range(6)]
    towards = math.sin(angle) - 1j * side * math.cos(angle)  # e_r, e_t as real and imaginary
    towards = towards if direction == "radial" else towards / 1j
    for m in (-3, -1, 0, 1, 2):
        expected = 0.01 * abs(
            0.5 * towards * window[abs(m - 1)] + 0.5 * np.conj(towards) * window[abs(m + 1)]
        )
        found = abs(line_of(readings, TURN * (99 + m)))
        assert found == pytest.approx(expected, rel=2e-3, abs=2e-6), m


def test_poles_amplify_a_line_as_masses_on_springs():
    poles = [{"frequency": 1900.0, "damping_ratio": 0.05}, {"frequency": 6000.0, "gain": -0.5}]
    plain, filtered = (
        measured(scene_with(sensor(**path)), lambda places: np.cos(99 * places))
        for path in ({}, {"law": "filter", "poles": poles})
    )
    for order in (99, 102):
        tone = TURN * order
        ones = [(tone / 1900.0, 0.05, 1.0), (tone / 6000.0, 0.02, -0.5)]
        gain = sum(g / (1.0 - x**2 + 2j * z * x) for x, z, g in ones)
        found = line_of(filtered, tone) / line_of(plain, tone)
        assert found == pytest.approx(gain, rel=1e-3)


def test_a_table_gives_gain_and_phase_between_its_rows():
    rows = [(0.0, 1.0, 0.0), (1500.0, 2.0, 0.5), (2500.0, 0.5, -1.5), (16_000.0, 0.1, 0.0)]
    table = [dict(zip(("frequency", "magnitude", "phase"), row, strict=True)) for row in rows]
    plain, filtered = (
        measured(scene_with(sensor(**path)), lambda places: np.cos(99 * places))
        for path in ({}, {"law": "filter", "table": table})
    )
    tone, share = 99 * TURN, (99 * TURN - 1500.0) / 1000.0
    gain = (2.0 - 1.5 * share) * np.exp(1j * (0.5 - 2.0 * share))
    assert len(filtered.values) < len(plain.values)  # the table lasts longer than the filter
    assert line_of(filtered, tone) / line_of(plain, tone) == pytest.approx(gain, rel=0.01)


def test_poles_have_their_own_gain_at_rest():
    path = FilteredWindow(law="filter", poles=[{"frequency": 100.0, "gain": 3.0}])
    assert path_response(path).at(np.zeros(1)) == pytest.approx(3.0)
