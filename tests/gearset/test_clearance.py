"""Clearance of planets: distances from the coordinates of their centres."""

import itertools
import math

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.gearset.clearance import Size, are_clear, most_planets
from planetary_twin_py.gearset.kinematics import Teeth
from planetary_twin_py.gearset.phasing import nearest_assembly

PAPER = pt.load_scene("paper")
SIZES = [
    Size(Teeth(sun, planet, sun + 2 * planet), 1e-3, addendum)
    for sun, planet in ((30, 20), (20, 80), (60, 18), (43, 17), (12, 60), (24, 12))
    for addendum in (0.8, 1.0)
]
on_all = pytest.mark.parametrize("size", SIZES, ids=str)


def gap(size, angles):
    """Least distance of two centres minus the tip diameter [m]."""
    radius = size.module * (size.teeth.sun + size.teeth.planet) / 2
    centres = radius * np.exp(1j * np.asarray(angles))
    least = min(abs(a - b) for a, b in itertools.combinations(centres, 2))
    return least - size.module * (size.teeth.planet + 2 * size.addendum)


@on_all
def test_planets_clear_each_other_if_centres_are_far_enough(size):
    rng = np.random.default_rng(1)
    for count in (2, 3, 4):
        for angles in rng.uniform(-10.0, 10.0, (50, count)):
            assert are_clear(size, angles) == (gap(size, angles) > 0.0)


@on_all
def test_reported_number_of_planets_fits_and_one_more_does_not(size):
    most = most_planets(size)
    for count, fits in ((most, True), (most + 1, False)):
        even = [2 * math.pi * n / count for n in range(count)]
        assert (gap(size, nearest_assembly(size.teeth, even)) > 0.0) == fits


@pytest.mark.parametrize(
    ("angles", "words"),
    [
        ((0, 90, 90, 270), ["planets 2 and 3", "is 0 mm and must", "tip diameter of 17.6 mm"]),
        ((0, 120, 480), ["planets 2 and 3", "is 0 mm"]),
        ([360 * n / 7 for n in range(7)], ["17.35", "at most 6 planets fit, equally spaced"]),
    ],
    ids=str,
)
def test_planets_that_touch_are_refused_in_one_line(angles, words):
    with pytest.raises(pt.SceneError, match=r"^gearset: planet_angles = ") as error:
        PAPER.replace(**{"gearset.planet_angles": [f"{angle} deg" for angle in angles]})
    message = str(error.value)
    assert "\n" not in message and "nearest" not in message
    assert [word for word in words if word not in message] == []


def test_a_shorter_addendum_clears_planets():
    seven = nearest_assembly(Teeth(30, 20, 70), [2 * math.pi * n / 7 for n in range(7)])
    with pytest.raises(pt.SceneError, match="at most 6 planets"):
        PAPER.replace(**{"gearset.planet_angles": seven})
    short = {"gearset.planet_angles": seven, "gearset.addendum": 0.4}
    assert PAPER.replace(**short).gearset.planets == 7
