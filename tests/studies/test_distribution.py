"""Tolerance studies: normal distributions and percentiles."""

from statistics import NormalDist

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.studies.axes import Normal, planet_by_planet, read_axis
from planetary_twin_py.studies.plan import Settings, grid, latin_hypercube

PAPER = pt.load_scene("paper")
TEXT = "normal(2 um, 0.1 um)"


def test_a_distribution_is_read_with_units_or_in_si():
    assert read_axis(PAPER, "backlash", TEXT) == Normal("backlash", 2e-6, pytest.approx(1e-7))
    assert read_axis(PAPER, "lambda_ratio", "normal(2,0.1)") == Normal("lambda_ratio", 2.0, 0.1)


@pytest.mark.parametrize(
    ("field", "text", "reason"),
    [
        ("backlash", "normal(2 um,0)", "2 um|0 has no unit"),
        ("backlash", "normal(2 um,0 um)", "must be above 0"),
        ("backlash", "normal(2 um)", "must be normal"),
        ("oil_temperature", "normal(70 degC,5 degC)", "must be in K"),
        ("dynamics", "normal(1,2)", "not a number"),
    ],
)
def test_what_is_no_distribution_is_refused_with_its_field(field, text, reason):
    with pytest.raises(ValueError, match=f"^{field}.*({reason})") as refusal:
        read_axis(PAPER, field, text)
    assert "\n" not in str(refusal.value)


def test_samples_are_one_in_each_stratum_of_the_distribution():
    study = latin_hypercube(PAPER, [Normal("backlash", 2e-6, 1e-7)], 200)
    drawn = np.sort([point.changes["backlash"] for point in study.points])
    law = NormalDist(2e-6, 1e-7)
    shares = np.array([law.cdf(value) for value in drawn])
    assert np.array_equal(np.floor(200 * shares), np.arange(200))


def test_distribution_needs_samples_and_values_that_field_has():
    axis = Normal("backlash", 1e-6, 1e-6)
    with pytest.raises(ValueError, match="requires a number of samples"):
        grid(PAPER, [axis], Settings())
    with pytest.raises(ValueError, match=r"^backlash = normal\(1e-06, 1e-06\): 50 samples reach"):
        latin_hypercube(PAPER, [axis], 50)


def test_each_planet_has_its_own_error():
    scene, names = planet_by_planet(PAPER, "errors.pin_tangential", "normal(0 um,5 um)")
    assert names == tuple(f"errors.pin_tangential.{i}" for i in range(3))
    study = latin_hypercube(scene, [read_axis(scene, n, "normal(0 um,5 um)") for n in names], 50)
    drawn = np.array([[*point.changes.values()] for point in study.points])
    assert np.abs(np.corrcoef(drawn.T)[np.triu_indices(3, 1)]).max() < 0.4
    assert drawn.std(axis=0) == pytest.approx(5e-6, rel=0.1)
    assert scene.replace(**study.points[0].changes).errors.pin_tangential == tuple(drawn[0])
    assert planet_by_planet(PAPER, "backlash", TEXT) == (PAPER, ("backlash",))
