"""A run under another load than that for which the entry of teeth was computed says so."""

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.checks.tooth_entry import entry_warning_at
from planetary_twin_py.model.teeth import build_tables

SCENE = pt.load_scene("paper").replace(
    **{"mesh.entry": "loaded", "drive.input.port": "torque", "input_torque": 63.0}
)


def run(times):
    """Run in which the motor gives its torque times a factor, from the start of settling on."""
    course = pt.Commands(np.array([0.0]), input_torque=np.array([63.0 * times]))
    return pt.simulate(SCENE, 0.01, commands=course, settling=0.1)


@pytest.mark.parametrize("times", [0.3, 2.0])
def test_another_torque_warns_with_the_error_of_shares(times):
    with pytest.warns(pt.AccuracyWarning, match=r"mesh\.entry = 'loaded': the mean") as found:
        run(times)
    (line,) = [str(w.message) for w in found if "mesh.entry" in str(w.message)]
    assert "load shares" in line


@pytest.mark.parametrize(("torque", "warns"), [(63.0, False), (56.0, False), (30.0, True)])
def test_a_torque_that_is_set_live_warns_by_its_error(torque, warns):
    twin = pt.Twin(SCENE.replace(**{"drive.input.port": "machine"}))
    twin.set(input_torque=torque)
    line = entry_warning_at(twin.start, twin.operating_point)
    assert (line is not None) == warns
    assert entry_warning_at(pt.load_scene("paper"), twin.operating_point) is None


@pytest.mark.parametrize("kind", [0, 1])
@pytest.mark.parametrize("times", [0.2, 0.5, 0.8, 1.25, 1.5])
def test_error_of_shares_is_the_difference_of_both_solutions(kind, times):
    """The shares at another torque are those of a scene that has it."""
    entry = build_tables(SCENE).entries[kind]
    other = build_tables(SCENE.replace(input_torque=63.0 * times)).entries[kind]
    cycle = np.linspace(0.0, 1.0, 97)
    far, here = (each.loads(cycle)[0] / each.force for each in (other, entry))
    error = entry.error_of_shares(times * entry.force)
    assert error == pytest.approx(np.abs(far - here).max(), rel=0.1)
    assert (error > 0.1) == (times in (0.2, 0.5, 1.5))
