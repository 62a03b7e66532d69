"""Strips of flanks: what colours them is what loads them."""

import math

import numpy as np
import pytest
from view.entity_rows import rerun

import planetary_twin_py as pt
from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.recording.runs.slow_states import SlowStates
from planetary_twin_py.view.flanks import CELLS, STRIPS, _strips
from planetary_twin_py.view.frames import frames
from planetary_twin_py.view.motion import motion
from planetary_twin_py.view.show import save

SCENE = pt.load_scene("paper").replace(**{"durability.wear": {"coefficient": 1e-18}})


@pytest.fixture
def recording(tour):
    return read_recording(tour)


def test_strips_have_the_pressure_and_the_wear_of_their_loads(recording):
    windows = frames(recording)
    number = int(np.abs(windows.time - 0.5).argmin())
    for kind, state in enumerate(_strips(windows, SCENE, motion(recording), number, None)):
        mesh = SCENE.gearset.geometry.meshes[kind]
        path = mesh.path
        position = -path.approach + path.contact_ratio * (np.arange(CELLS) + 0.5) / CELLS
        pressure = state.pressure.reshape(STRIPS, CELLS)
        one = position > path.recess - 0.97  # where one pair carries the force
        alone = one & (position < 0.97 - path.approach)
        rho1, rho2 = mesh.curvatures_at(position[alone])
        curvature = 1.0 / rho1 + (-1.0 if mesh.internal else 1.0) / rho2
        oil = SCENE.lubrication
        modulus = oil.youngs_modulus / (2.0 * (1.0 - oil.poisson_ratio**2))
        static = 63.0 / (3.0 * SCENE.gearset.geometry.sun.base_radius) / 20e-3
        expected = np.sqrt(static * modulus * curvature / math.pi)
        assert pressure[:, alone] == pytest.approx(np.tile(expected, (STRIPS, 1)), rel=0.12)
        wear = state.wear.reshape(STRIPS, CELLS)
        assert np.nanargmax(wear.mean(axis=0)) in (0, 1, CELLS - 2, CELLS - 1)
        assert np.nanmin(wear) < 0.05 * np.nanmax(wear)
        assert np.nanmin(state.temperature) > 343.0
        assert np.nanmax(state.temperature) < 343.15 + 40.0


def test_gears_are_as_warm_as_in_a_recording_with_temperatures(recording):
    windows, time = frames(recording), np.array([0.0, 1.0])
    number = int(np.abs(windows.time - 0.5).argmin())
    values = np.array([[380.0, 360.0, 350.0], [382.0, 362.0, 352.0]])
    warm = SlowStates(("sun", "planet", "ring"), time, np.zeros(2, dtype=np.int64), values)
    means = 371.0, 356.0  # of both gears of a mesh, half-way, or next to it
    for mean, state in zip(
        means, _strips(windows, SCENE, motion(recording), number, warm), strict=True
    ):
        assert mean - 1.0 < np.nanmin(state.temperature) < mean + 1.0
        assert np.nanmax(state.temperature) > mean + 3.0


def test_the_file_contains_the_strips_of_the_scene(recording, tmp_path):
    for scene, wears in ((SCENE, True), (pt.load_scene("paper"), False)):
        save(recording, scene, tmp_path / "a.rrd")
        printed = rerun("print", tmp_path / "a.rrd")
        for entity in ("/flanks/pressure/strips", "/flanks/temperature/picture"):
            assert entity in printed
        assert ("/flanks/wear/strips" in printed) is wears
