"""Texts of public objects at a prompt are short, and name what the object is about."""

import numpy as np
import pytest

import planetary_twin_py as pt

PAPER = pt.load_scene("paper")
LONGEST = 300  # characters


@pytest.fixture(scope="module")
def shown():
    """Texts of public objects by the names of their classes."""
    result = pt.simulate(PAPER, 0.01)
    twin = pt.Twin(PAPER, tolerance=1e-4)
    window = twin.advance(0.01)
    (outcome,) = pt.simulate_many([PAPER], 0.01)
    objects = [
        result, result.stats, result.energy, twin, window, window.waveform, outcome,
        pt.Twins([PAPER, PAPER]), pt.Commands(np.arange(1000.0), input_torque=np.ones(1000)),
        pt.Follower(PAPER), pt.Fleet(PAPER, 3), twin.log[-1], pt.choose_dynamics(PAPER),
    ]  # fmt: skip
    return {type(each).__name__: repr(each) for each in objects}


def test_they_are_one_short_line(shown):
    for name, text in shown.items():
        assert text.startswith(f"{name}(") and "\n" not in text
        assert len(text) <= LONGEST, name


def test_a_result_has_its_length_and_its_efficiency(shown):
    assert shown["Result"].startswith("Result(0.01 s, 500 samples, 6 meshes, efficiency 0.98")
    assert shown["Outcome"] == f"Outcome(place=0, scene=paper, found={shown['Result']})"


def test_a_long_or_hostile_name_stays_one_short_line():
    text = repr(pt.Twin(PAPER.replace(name="a\nb" * 500)))
    assert "\n" not in text and len(text) < LONGEST
