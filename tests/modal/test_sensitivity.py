"""Slopes of natural frequencies against finite differences."""

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.modal.modes import modes_of
from planetary_twin_py.modal.natural import spring_model
from planetary_twin_py.modal.sensitivity import frequency_sensitivities

CASES = [
    ("paper", "torsional"),
    ("wind_turbine_stage", "planar"),
    ("wind_turbine_stage", "machines"),
]


def with_stiffness(model, kind, factor):
    springs = tuple(
        s._replace(stiffness=s.stiffness * factor) if s.kind == kind else s for s in model.springs
    )
    return model._replace(springs=springs)


@pytest.mark.parametrize("name, model", CASES)
def test_slopes_are_those_of_finite_differences(name, model):
    springs = spring_model(pt.load_scene(name), model)
    for kind, slopes in frequency_sensitivities(springs).items():
        k = next(s.stiffness for s in springs.springs if s.kind == kind)
        if k == 0.0:
            continue
        changed = (with_stiffness(springs, kind, f) for f in (1.0001, 0.9999))
        up, down = (modes_of(each).frequencies for each in changed)
        measured = (up - down) / (2e-4 * k)
        elastic = ~np.isnan(slopes)
        assert slopes[elastic] == pytest.approx(measured[elastic], rel=1e-3, abs=1e-12 * up[-1])


def test_all_stiffnesses_together_count_by_half_their_change():
    springs = spring_model(pt.load_scene("paper"))
    slopes, modes = frequency_sensitivities(springs), modes_of(springs)
    total = sum(slopes[kind] * 2e8 for kind in ("sun_planet", "planet_ring"))
    assert total[1:] == pytest.approx(0.5 * modes.frequencies[1:])
