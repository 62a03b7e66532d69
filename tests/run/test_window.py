"""A window of a twin: one call of the core, which shows what a whole run shows."""

import numpy as np
import pytest
from stability.sound import PAPER
from tiers import first

import planetary_twin_py as pt

SCENES = {
    "steady until it repeats": PAPER,
    "rattle": PAPER.replace(input_torque=0.3, torque_ripple=3.0),
    "merged planets": pt.load_scene("wind_turbine_stage"),
    "differential": pt.load_scene("differential"),
    "quasi-static": PAPER.replace(dynamics="quasi_static"),
}


@pytest.mark.parametrize("scene", first(2, SCENES.values()), ids=SCENES)
def test_waveforms_of_windows_are_samples_of_run_to_the_last_bit(scene):
    duration = 0.02 if scene.dynamics == "quasi_static" else 2.0
    run, twin = pt.simulate(scene, duration, 10_000.0, tolerance=1e-3), pt.Twin(scene, 1e4, 1e-3)
    windows = [twin.advance(duration / 8) for _ in range(8)]
    waves = [window.waveform for window in windows]
    friction = run.boundary_friction + run.viscous_friction
    for name, whole in (
        ("time", run.time),
        ("dte", run.dte),
        ("mesh_force", run.mesh_force),
        ("friction", friction),
    ):
        parts = np.concatenate([getattr(wave, name) for wave in waves])
        assert np.array_equal(parts, whole), name
    if scene is PAPER:
        assert windows[-1].repeated


def test_window_keeps_its_figures_when_the_next_one_is_computed():
    twin = pt.Twin(PAPER)
    first = twin.advance(0.01)
    before = {name: values.copy() for name, values in first.mesh.items()}
    angle, speed, torque = first.angle.copy(), first.mean_speed.copy(), first.machine_torque.copy()
    twin.set(input_torque=20.0)
    twin.advance(0.0123)
    for name, values in before.items():
        assert np.array_equal(first.mesh[name], values, equal_nan=True)
    assert np.array_equal(first.angle, angle)
    assert np.array_equal(first.mean_speed, speed)
    assert np.array_equal(first.machine_torque, torque)
