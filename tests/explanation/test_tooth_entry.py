"""Peak loads of tooth pairs by their entry, against statics."""

import math

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.explanation.tooth_entry import entry_peaks
from planetary_twin_py.model.teeth import build_tables

STILL = pt.load_scene("paper").replace(  # planets mesh in phase, so all have the same load
    dynamics="quasi_static",
    **{"lubrication.friction": False, "gearset.planet_angles": (0.0, math.pi)},
)


@pytest.fixture(scope="module")
def peaks():
    return {each.entry: each for each in entry_peaks(STILL, 0.02)}


def test_half_whole_and_double_ramp_are_compared_with_loaded_entry(peaks):
    assert list(peaks) == ["ramp 0.015", "ramp 0.03", "ramp 0.06", "loaded"]
    assert not any(each.refused for each in peaks.values())


def test_without_vibration_one_pair_carries_the_static_force(peaks):
    for name, each in peaks.items():
        expected = (1.0, 1.0) if name != "loaded" else (1.0, largest_share(1))
        assert each.peaks == pytest.approx(expected, rel=0.01)  # of samples


def largest_share(kind):
    """In ring meshes of this scene under load, two pairs or more are in contact."""
    entry = build_tables(STILL.replace(**{"mesh.entry": "loaded"})).entries[kind]
    share = float((entry.loads(np.linspace(0.0, 1.0, 2001))[0] / entry.force).max())
    assert share < 0.7
    return share


def test_entries_that_a_scene_cannot_have_are_named_with_the_reason():
    helical = pt.load_scene("helical_stage").replace(dynamics="quasi_static")
    *ramps, loaded = entry_peaks(helical, 0.01)
    assert all(each.peaks for each in ramps)
    assert loaded.peaks == ()
    assert "mesh" in loaded.refused
