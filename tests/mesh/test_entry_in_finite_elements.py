"""Entry of loaded teeth against two gears of plane-strain finite elements in contact.

What the elements know and the law does not: a contact at a tip is softer than one on a flank, and a
pair two teeth away moves the tooth, too. Both are in the tolerances.
"""

import math
from functools import cache

import numpy as np
import pytest
from mesh.plane_contact import TEETH, Gear, PlaneMesh
from tiers import first_rows

from planetary_twin_py.gearset.involute import SpurGear
from planetary_twin_py.gearset.separation import separation
from planetary_twin_py.gearset.working import WorkingMesh
from planetary_twin_py.mesh.loaded_entry import NEIGHBOURS, Entry
from planetary_twin_py.mesh.stiffness import tooth_stiffness
from planetary_twin_py.tooth.contact import weber_banaschek
from planetary_twin_py.tooth.material import Material
from planetary_twin_py.tooth.pair import ToothPair
from planetary_twin_py.tooth.tooth import HUB, RIM, Tooth

ANGLE = math.radians(21.34)
ELEMENT = 0.12  # [modules]; half of it changes shares by at most 0.02
WITHIN = 0.04  # [modules] gaps that are looked at
HEAVY, LIGHT, VANISHING = 1e-3, 5e-4, 1e-5  # force over module, face width and Young's modulus
BEYOND = np.array([0.02, 0.04, 0.06, 0.08])  # base pitches off the path
MESHES = pytest.mark.parametrize(
    ("internal", "of_share", "of_deflection"),
    first_rows(1, [(False, 0.035, 0.05), (True, 0.05, 0.06)]),
)


@cache
def mesh_of(internal):
    """Both solutions: a function of the force for springs behind gaps, and the elements."""
    gears = (
        (SpurGear(20, 1.0, ANGLE), SpurGear(70, 1.0, ANGLE, internal=True))
        if internal
        else (SpurGear(30, 1.0, ANGLE), SpurGear(20, 1.0, ANGLE))
    )
    teeth = [Tooth(gear, Material(1.0, 0.3), RIM if gear.internal else HUB) for gear in gears]
    mesh = WorkingMesh(*gears, 25.0)

    def entry(force):
        pair = ToothPair(*teeth, mesh.path, weber_banaschek(force))
        law = tooth_stiffness(lambda s: pair.stiffness(s, 1.0), mesh.path, pair.shared_body_factor)
        return Entry(mesh.path, lambda s: separation(mesh, s), law, force)

    models = [Gear(tooth.profile, tooth.held, ELEMENT) for tooth in teeth]
    return mesh, entry, PlaneMesh(mesh, *models)


def both(internal, force, positions):
    """Shares of the pairs `TEETH` and deflections, of the springs and of the elements."""
    _, entry, plane = mesh_of(internal)
    loads, deflection = entry(force).loads(positions)
    pairs = [list(NEIGHBOURS).index(tooth) for tooth in TEETH]
    pressed = [plane.press(each, force, WITHIN) for each in positions]
    return (
        (loads[:, pairs] / force, deflection),
        (
            np.array([each.loads / force for each in pressed]),
            np.array([each.deflection for each in pressed]),
        ),
    )


@MESHES
@pytest.mark.parametrize("force", [HEAVY, LIGHT])
def test_shares_and_deflection_over_the_cycle(internal, of_share, of_deflection, force):
    springs, elements = both(internal, force, np.linspace(-0.5, 0.5, 20, endpoint=False))
    np.testing.assert_allclose(springs[0], elements[0], atol=of_share)
    np.testing.assert_allclose(springs[1], elements[1], rtol=of_deflection)


@MESHES
def test_pairs_carry_load_off_their_path(internal, of_share, of_deflection):
    path = mesh_of(internal)[0].path
    ends = np.concatenate([-path.approach - BEYOND, path.recess + BEYOND])
    middle = (ends + 0.5) % 1.0 - 0.5
    column = [TEETH.index(each) for each in np.rint(ends - middle)]
    rows = np.arange(len(ends))
    (springs, _), (elements, _) = both(internal, HEAVY, middle)
    found, expected = springs[rows, column], elements[rows, column]
    assert expected[0] > 0.25 and expected.min() > 0.05  # where a ramp on the path has none
    np.testing.assert_allclose(found, expected, atol=of_share)


@MESHES
def test_without_load_only_pairs_on_their_path_touch(internal, of_share, of_deflection):
    path = mesh_of(internal)[0].path
    positions = np.linspace(-0.5, 0.5, 20, endpoint=False)
    place = positions[:, None] + np.array(TEETH)
    off = np.maximum(-path.approach - place, place - path.recess) > BEYOND[0]
    alone = off.sum(axis=1) == len(TEETH) - 1
    assert internal or alone.any()  # with the ring, two pairs or more are in contact
    for shares, _ in both(internal, VANISHING, positions):
        np.testing.assert_array_equal(shares[off], 0.0)
        np.testing.assert_allclose(shares[alone].max(axis=1, initial=1.0), 1.0)
