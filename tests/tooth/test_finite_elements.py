"""The tooth on its body against plane-strain finite elements of the same outline.

What is compared is the mean displacement of the loaded flank under an elliptic pressure: beam,
body and half of Weber's contact on one side, nine-node elements on the other.
"""

import math

import numpy as np
import pytest
from tiers import first
from tooth.plane_strain import GearModel

from planetary_twin_py.gearset.involute import SpurGear
from planetary_twin_py.tooth.crack import Crack
from planetary_twin_py.tooth.material import Material
from planetary_twin_py.tooth.tooth import Tooth

UNIT = Material(1.0, 0.3)
HALF_WIDTH, SMALLEST = 0.06, 0.02  # of contact and elements, in modules
GEARS = pytest.mark.parametrize(
    ("teeth", "alpha", "internal", "held"),
    [
        (20, 21.34, False, 0.5),
        (30, 21.34, False, 0.5),
        (60, 20.0, False, 0.8),
        (70, 21.34, True, 1.2),
    ],
)


def tooth_and_load(teeth, alpha, internal, held, share):
    """A tooth and the radius of a load at a share of the flank's height."""
    tooth = Tooth(SpurGear(teeth, 1.0, math.radians(alpha), internal=internal), UNIT, held)
    start, tip = tooth.profile.flank_start, tooth.gear.tip_radius
    return tooth, start + share * (tip - start)


def local(tooth, radius):
    """Half of Weber's contact, for the half-width that the elements are loaded with."""
    depth = tooth.profile.depth(radius)
    return 2 * (1 - 0.3**2) / math.pi * (np.log(2 * depth / HALF_WIDTH) - 0.3 / (2 * (1 - 0.3)))


@GEARS
@pytest.mark.parametrize("share", first(1, [0.5, 0.1, 0.9]))
def test_flank_yields_as_finite_elements_do(teeth, alpha, internal, held, share):
    tooth, at = tooth_and_load(teeth, alpha, internal, held, share)
    model = GearModel(tooth.profile, held, at, SMALLEST)
    force, *_ = model.press(at, HALF_WIDTH)
    yields = np.sum(force * model.solve(force))
    radius = np.array([at])
    ours = tooth.beam(radius) + tooth.body(radius) + local(tooth, radius)
    assert 0.98 < ours[0] / yields < 1.07


@GEARS
@pytest.mark.parametrize("neighbour", first(1, [1, -1]))
def test_neighbouring_tooth_is_moved_as_in_finite_elements(teeth, alpha, internal, held, neighbour):
    tooth, at = tooth_and_load(teeth, alpha, internal, held, 0.3)
    _, there = tooth_and_load(teeth, alpha, internal, held, 0.7)
    model = GearModel(tooth.profile, held, at, 2 * SMALLEST)
    moved = model.solve(model.press(at, HALF_WIDTH)[0])
    crossing, angle = (x[0] for x in tooth.profile.load(np.array([there])))
    inwards = 1.0 if internal else -1.0
    # The elements are pushed clockwise, the model counter-clockwise.
    direction = np.array([inwards * math.sin(angle), -math.cos(angle)])
    found = model.centre_line(moved, crossing, neighbour) @ direction
    ours = tooth.body_coupling(np.array([there]), np.array([at]), -neighbour)
    assert ours[0] == pytest.approx(found, rel=0.05)


@pytest.mark.parametrize("teeth", [20, 30])
@pytest.mark.parametrize("columns", first(1, [4, 6]))
def test_cracked_tooth_yields_as_finite_elements_do(teeth, columns):
    """A crack square to the centre line, to a sixth and to a third of the thickness."""
    tooth, at = tooth_and_load(teeth, 21.34, False, 0.5, 0.7)
    radius = np.array([at])

    def on_centre_line(cracked):
        model = GearModel(tooth.profile, 0.5, at, 2 * SMALLEST, cracked)
        force, direction, crossing = model.press(at, HALF_WIDTH)
        moved = model.centre_line(model.solve(force), crossing) @ direction
        return moved, model.crack_depth

    healthy, _ = on_centre_line(0)
    found, depth = on_centre_line(columns)
    cracked = Tooth(tooth.gear, UNIT, 0.5, Crack(depth, 0.5 * math.pi))
    ours = (cracked.beam(radius) + cracked.body(radius))[0]
    assert ours == pytest.approx(found, rel=0.06)
    grown = ours - (tooth.beam(radius) + tooth.body(radius))[0]
    assert grown == pytest.approx(found - healthy, rel=0.25)
