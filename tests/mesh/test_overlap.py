"""Helical teeth: means over the face, against slices added up here."""

import math

import numpy as np
import pytest

from planetary_twin_py._core import PAIRS, TERMS, TOTAL
from planetary_twin_py.gearset.geometry import PathOfContact
from planetary_twin_py.mesh.overlap import FaceMean, largest_overlap, overlap_ratio
from planetary_twin_py.mesh.stiffness import given_stiffness, tooth_stiffness
from planetary_twin_py.mesh.tooth_pairs import NoRoomError, pair_table

PATH = PathOfContact(0.7, 0.85)
OVERLAPS = pytest.mark.parametrize("overlap", [0.05, 0.446, 1.0, 1.9951, 3.1, 5.7])
RAMPS = pytest.mark.parametrize("ramp", [0.0, 0.03])
SLICES = 20001
GIVEN = given_stiffness(2e8, 1.75)
TEETH = tooth_stiffness(lambda s: 2e8 * (1.0 - 0.2 * s**2), PATH, 0.9)


def total(table, cycle):
    """Sum of the weights of all pairs at fractions of the mesh cycle."""
    cycle = table.edge[0] + np.mod(cycle - table.edge[0], 1.0)
    j = np.searchsorted(table.edge[: table.segments], cycle, side="right") - 1
    powers = (cycle - table.edge[j])[:, None] ** np.arange(TERMS)
    return (table.weight[j, TOTAL] * powers).sum(axis=1)


def face(overlap):
    """Places of the slices [mesh cycles], the middles of equal parts of the face."""
    return overlap * ((np.arange(SLICES) + 0.5) / SLICES - 0.5)


def test_overlap_ratio_of_a_published_gear():
    """NREL 5 MW reference gearbox, first stage: 0.491 m wide, normal module 45.7 mm, 7.495 deg; the
    overlap ratio is b sin(beta)/(pi m_n)."""
    helix, normal = math.radians(7.495), 45.7e-3
    transverse = math.atan(math.tan(math.radians(25.0)) / math.cos(helix))
    pitch = math.pi * normal / math.cos(helix) * math.cos(transverse)
    base = math.atan(math.tan(helix) * math.cos(transverse))
    expected = 0.491 * math.sin(helix) / (math.pi * normal)
    assert overlap_ratio(0.491, base, pitch) == pytest.approx(expected, rel=1e-12)
    assert overlap_ratio(0.491, -base, pitch) == overlap_ratio(0.491, base, pitch)


@OVERLAPS
@RAMPS
@pytest.mark.parametrize("law", [GIVEN, TEETH])
def test_the_stiffness_is_the_mean_of_the_slices(overlap, ramp, law):
    spur = pair_table(PATH, ramp, law.strength, law.sharing)
    table = FaceMean(PATH, ramp, overlap, law).table()
    for cycle in np.linspace(0.0, 1.0, 23):
        slices = total(spur, cycle + face(overlap)).mean()
        assert total(table, np.array([cycle]))[0] == pytest.approx(slices, abs=4.0 / SLICES)


@pytest.mark.parametrize("overlap", [1.0, 2.0, 4.0, 6.0])
def test_a_whole_overlap_leaves_a_constant_stiffness(overlap):
    table = FaceMean(PATH, 0.03, overlap, GIVEN).table()
    stiffness = total(table, np.linspace(0.0, 1.0, 101))
    assert np.ptp(stiffness) < 1e-9 * stiffness.mean()


@OVERLAPS
def test_edges_are_those_of_the_lines_of_contact_alone(overlap):
    """Where a slice starts or ends; at the pitch point of the middle of the face nothing does."""
    table = FaceMean(PATH, 0.0, overlap, GIVEN).table()
    places = (-PATH.approach, 0.0, PATH.recess)
    ends = {
        round((place + half) % 1.0, 12) for place in places for half in (-overlap / 2, overlap / 2)
    }
    assert np.mod(table.edge[: table.segments], 1.0) == pytest.approx(sorted(ends))
    assert table.edge[table.segments] == table.edge[0] + 1.0


@OVERLAPS
def test_parts_of_contact_line_are_before_and_after_pitch_point(overlap):
    """Each part has the weight of its slices, and its contact in their middle."""
    table = FaceMean(PATH, 0.0, overlap, GIVEN).table()
    for j, p in zip(*np.nonzero(table.present), strict=True):
        cycle = 0.25 * table.edge[j] + 0.75 * table.edge[j + 1]
        pair, mark = math.floor(table.shift[j, p]), table.shift[j, p] % 1.0
        slices = cycle + pair + face(overlap)
        first, last = (0.0, PATH.recess) if mark else (-PATH.approach, 0.0)
        touching = slices[(slices > first) & (slices < last)]
        middle = table.centre[j, p] + table.travel[j, p] * cycle
        assert middle == pytest.approx(touching.mean(), abs=4.0 * overlap / SLICES)
        share = table.face[j, p] + table.face_growth[j, p] * cycle
        assert share == pytest.approx(len(touching) / SLICES, abs=2.0 / SLICES)
        powers = (cycle - table.edge[j]) ** np.arange(TERMS)
        weight = table.weight[j, p] @ powers
        assert weight == pytest.approx(len(touching) / SLICES, abs=2.0 / SLICES)


def test_a_fault_weakens_the_mean_of_the_slices_it_is_in():
    overlap, corners = 0.6, [-0.2, -0.15, 0.1, 0.15]
    face_mean = FaceMean(PATH, 0.03, overlap, GIVEN, corners)

    def spall(s):
        return 1.0 - 0.5 * np.interp(s, corners, [0.0, 1.0, 1.0, 0.0])

    table, factors = face_mean.table(), face_mean.factors(spall)
    ends = [-PATH.approach, -PATH.approach + 0.03, PATH.recess - 0.03, PATH.recess]
    for j in range(table.segments):
        cycle = 0.4 * table.edge[j] + 0.6 * table.edge[j + 1]
        powers, found = (cycle - table.edge[j]) ** np.arange(TERMS), 0.0
        for p in np.flatnonzero(table.present[j]):
            found += (table.weight[j, p] @ powers) * (factors[j, p] @ powers)
        slices = cycle + face(overlap)[:, None] + np.arange(-4, 5)
        weight = np.interp(slices, ends, [0.0, 1.0, 1.0, 0.0], left=0.0, right=0.0)
        expected = (weight * spall(slices)).sum(axis=1).mean()
        assert found == pytest.approx(expected, abs=2e-4)


def test_largest_overlap_is_last_for_which_the_table_has_room():
    largest = largest_overlap(PATH)
    assert FaceMean(PATH, 0.03, largest, GIVEN).table().present.sum(axis=1).max() == PAIRS
    with pytest.raises(NoRoomError, match="17 parts of tooth pairs are in contact at once"):
        FaceMean(PATH, 0.03, largest + 1e-3, GIVEN)
