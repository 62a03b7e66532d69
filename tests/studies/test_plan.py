"""Grids contain every combination; Latin hypercubes fill every stratum; keys depend on inputs."""

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.studies.axes import Axis, Span
from planetary_twin_py.studies.plan import Settings, grid, latin_hypercube

PAPER = pt.load_scene("paper")
TORQUES = Axis("input_torque", (10.0, 20.0, 30.0))
FILMS = Axis("lambda_ratio", (1.0, 2.0))


def test_a_grid_contains_every_combination_once():
    study = grid(PAPER, [TORQUES, FILMS])
    found = [tuple(point.changes.values()) for point in study.points]
    assert found == [(t, f) for t in TORQUES.values for f in FILMS.values]
    assert [point.place for point in study.points] == list(range(6))


def test_each_hypercube_point_has_its_own_stratum_on_each_axis():
    spans = [Span("input_torque", 10.0, 30.0), Span("backlash", 1e-7, 1e-5, logarithmic=True)]
    study = latin_hypercube(PAPER, [*spans, FILMS], samples=20, seed=3)
    torque, backlash, film = (
        np.array([point.changes[name] for point in study.points]) for name in study.fields
    )
    assert sorted((torque - 10.0) // 1.0) == list(range(20))
    assert sorted(np.floor(10.0 * np.log10(backlash / 1e-7))) == list(range(20))
    assert np.count_nonzero(film == 1.0) == 10
    assert latin_hypercube(PAPER, [*spans, FILMS], 20, seed=3) == study
    assert latin_hypercube(PAPER, [*spans, FILMS], 20, seed=4) != study


def test_a_key_depends_on_all_inputs_of_the_figures_alone():
    study = grid(PAPER, [TORQUES])
    first, second, _ = study.points
    keys = {
        study.key(first, "a"),
        study.key(second, "a"),
        study.key(first, "b"),
        grid(PAPER.replace(backlash=3e-7), [TORQUES]).key(first, "a"),
        grid(PAPER, [TORQUES], Settings(duration=0.1)).key(first, "a"),
    }
    assert len(keys) == 5
    wider = grid(PAPER.replace(name="other"), [Axis("input_torque", (5.0, 10.0))])
    assert wider.key(wider.points[1], "a") == study.key(first, "a")


@pytest.mark.parametrize(
    ("make", "reason"),
    [
        (lambda: grid(PAPER, []), "no field varies"),
        (lambda: grid(PAPER, [TORQUES, TORQUES]), "input_torque: given twice"),
        (lambda: grid(PAPER, [Span("backlash", 1e-7, 2e-7)]), "backlash: a range without a count"),
        (lambda: grid(PAPER, [Axis("backlash", (1e-7,) * 2000)] * 3), "8000000000 points"),
        (lambda: grid(PAPER, [FILMS], Settings(duration=0.0)), r"duration = 0\.0 s"),
        (lambda: latin_hypercube(PAPER, [FILMS], 0), "samples = 0"),
    ],
)
def test_an_invalid_plan_is_refused_in_one_line(make, reason):
    with pytest.raises(ValueError, match=reason) as refusal:
        make()
    assert "\n" not in str(refusal.value)
