"""The table of tooth pairs against the trapezoid it tabulates."""

import math

import numpy as np
import pytest
from paths import planet_ring_path, sun_planet_path

from planetary_twin_py._core import PAIRS, TERMS, TOTAL
from planetary_twin_py.gearset.geometry import PathOfContact
from planetary_twin_py.gearset.kinematics import Teeth
from planetary_twin_py.mesh.tooth_pairs import along, mean_weight, pair_table, terms_in_use

PAPER = Teeth(30, 20, 70), math.radians(21.34), 1.0
EXTERNAL, INTERNAL = sun_planet_path(*PAPER), planet_ring_path(*PAPER)
PATHS = pytest.mark.parametrize(
    "path", [EXTERNAL, INTERNAL, PathOfContact(1.0, 0.3), PathOfContact(1.3, 1.2)]
)
RAMPS = pytest.mark.parametrize("ramp", [0.0, 0.03, 0.2])


def weights(table, x, segment=None):
    """Positions and weights of all pairs at the cycle fraction x."""
    if segment is None:
        segment = np.searchsorted(table.edge[: table.segments], x, side="right") - 1
    powers = (x - table.edge[segment]) ** np.arange(TERMS)
    return x + table.shift[segment], table.weight[segment, :PAIRS] @ powers


@PATHS
@RAMPS
def test_every_pair_has_the_trapezoid_of_its_position(path, ramp):
    table = pair_table(path, ramp)
    corners = [-path.approach, -path.approach + ramp, path.recess - ramp, path.recess]
    for x in np.linspace(0.0, 1.0, 997, endpoint=False) + 1e-5:
        s, weight = weights(table, x)
        present = table.present[np.searchsorted(table.edge[: table.segments], x, side="right") - 1]
        candidates = x + np.arange(-PAIRS, PAIRS + 1)
        inside = candidates[(candidates > -path.approach) & (candidates < path.recess)]
        assert np.sort(s[present]) == pytest.approx(inside, abs=1e-12)
        assert not weight[~present].any()
        expected = np.interp(s[present], corners, [0.0, 1.0, 1.0, 0.0]) if ramp else 1.0
        assert weight[present] == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("missing", [0.0, 1e-13, -1e-13])
def test_a_path_that_ends_a_base_pitch_off_has_no_empty_part(missing):
    """Its end is at the edge of the pitch point, also if it misses it by rounding."""
    table = pair_table(PathOfContact(1.0 + missing, 0.4), 0.0)
    assert np.diff(table.edge[: table.segments + 1]).min() > 0.1
    assert np.isfinite(table.weight).all()


@pytest.mark.parametrize("path", [PathOfContact(0.6, 0.42), PathOfContact(1.6, 1.5)])
def test_contact_ratios_outside_the_table_are_refused(path):
    with pytest.raises(ValueError, match="contact ratio"):
        pair_table(path, 0.03)


@PATHS
def test_smooth_strength_along_path_is_tabulated_to_five_digits(path):
    def strength(s):
        return 1.0 / (1.0 + 0.4 * (s - 0.1) ** 2)

    table = pair_table(path, 0.03, strength)
    for x in np.linspace(0.0, 1.0, 101)[:-1] + 1e-3:
        s, weight = weights(table, x)
        ends = [-path.approach, -path.approach + 0.03, path.recess - 0.03, path.recess]
        expected = strength(s) * np.interp(s, ends, [0.0, 1.0, 1.0, 0.0], left=0.0, right=0.0)
        segment = np.searchsorted(table.edge[: table.segments], x, side="right") - 1
        present = table.present[segment]
        assert weight[present] == pytest.approx(expected[present], abs=1e-5)


@PATHS
@RAMPS
def test_the_total_is_the_sum_over_the_pairs(path, ramp):
    table = pair_table(path, ramp)
    assert table.weight[:, TOTAL] == pytest.approx(table.weight[:, :PAIRS].sum(axis=1))
    assert terms_in_use(table) == 2


def test_positions_of_a_fault_become_edges():
    table = pair_table(EXTERNAL, 0.03, kinks=(-0.1, 0.15))
    for kink in (0.9, 0.15):
        assert np.abs(table.edge - kink).min() < 1e-9
    pit = along(table, lambda s: np.interp(s, [-0.1, 0.15], [1.0, 0.5]))
    j = int(np.argmin(np.abs(table.edge[: table.segments] - 0.15)))
    p = int(np.nonzero(table.shift[j] == 0.0)[0][0])
    assert pit[j, p, 0] == pytest.approx(0.5)


def test_mean_weight_of_a_strength_is_its_integral_over_the_path():
    table = pair_table(EXTERNAL, 0.0, lambda s: 1.0 - 0.3 * s**2)
    a, r = EXTERNAL
    mean = mean_weight(table.edge, table.weight[:, TOTAL])
    assert mean == pytest.approx(a + r - 0.1 * (a**3 + r**3))
