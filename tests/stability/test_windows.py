"""Windows look at a run; however long they are, they do not change it."""

import numpy as np
import pytest
from stability.sound import PAPER

import planetary_twin_py as pt

REGIMES = {
    "steady": {},
    "rattle": {"input_torque": 0.3, "torque_ripple": 3.0},
    "creep": {"input_speed": 1e-6},
    "through zero": {"drive.speed_control.start_speed": -20.0, "input_speed": 300.0},
    "undamped": {"mesh.damping.law": "viscous", "mesh.damping.damping_ratio": 0.0},
}
EVERY_REGIME = pytest.mark.parametrize("name", REGIMES)


def seen(twin, window, until):
    """Every sample from now on, and where the twin stands at the end."""
    parts, end = [], {}
    for _ in range(round((until - twin.time) / window)):
        end = twin.advance(window)
        wave = end.waveform
        parts.append(np.hstack([wave.dte, wave.mesh_force, wave.friction]))
    return np.vstack(parts), end.angle


@EVERY_REGIME
def test_a_change_has_the_same_effect_for_all_lengths_of_windows(name):
    changes = [{"lambda_ratio": 2.0}, {"backlash": 4e-7}, {"input_torque": 20.0}, {}]

    def run(window):
        twin = pt.Twin(PAPER.replace(**REGIMES[name]), 2e4)
        parts = []
        for n, change in enumerate(changes, 1):
            parts.append(seen(twin, window, 7e-3 * n)[0])
            twin.set(**change)
        return np.vstack(parts)

    whole = run(7e-3)
    for window in (1e-3, 1e-4, 3.5e-3):
        assert np.array_equal(run(window), whole)


def test_windows_of_nanosecond_pass_same_states_and_give_speeds():
    twin, other = pt.Twin(PAPER), pt.Twin(PAPER)
    windows = [twin.advance(1e-9) for _ in range(2000)]
    assert twin.time == pytest.approx(2e-6, rel=1e-9)
    speeds = np.array([window.input_speed for window in windows])
    assert speeds == pytest.approx(pt.rpm(1000), rel=1e-3)
    assert len(other.advance(2e-6).waveform.time) == 0
    assert np.array_equal(twin.advance(1e-2).waveform.dte, other.advance(1e-2).waveform.dte)


def test_a_window_shorter_than_the_clock_resolves_is_refused():
    with pytest.raises(ValueError, match="duration = 4e-13 s"):
        pt.Twin(PAPER).advance(4e-13)


@pytest.mark.parametrize("duration", [3600.0, 60.000001, 0.0, -1e-9, np.inf, np.nan])
def test_an_impossible_window_is_refused_in_one_line(duration):
    twin = pt.Twin(PAPER)
    with pytest.raises(ValueError, match=r"^duration = .*at most 60$"):
        twin.advance(duration)
    assert twin.time == 0.0


def test_a_window_of_few_samples_may_be_longer():
    """4096 samples at most: as a mesh cycle at a thousandth of a turn a minute needs."""
    scene = PAPER.replace(dynamics="quasi_static", input_speed=pt.rpm(0.001))
    twin = pt.Twin(scene, 1.0)
    with pytest.raises(ValueError, match=r"^duration = 4097\.0 s: .*at most 4096$"):
        twin.advance(4097.0)
    window = twin.advance(2000.0)
    assert len(window.waveform.time) == 2000
    assert window.mesh_frequency == pytest.approx(5e-4, rel=1e-6)
