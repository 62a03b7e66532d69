"""The table of tooth pairs against the trapezoid it tabulates."""

import math

import numpy as np
import pytest

from planetary_twin_py.gearset.geometry import PathOfContact, planet_ring_path, sun_planet_path
from planetary_twin_py.gearset.kinematics import Teeth
from planetary_twin_py.mesh.tooth_pairs import PAIRS, pair_table

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
    return x + table.shift[segment], table.offset[segment] + table.slope[segment] * x


@PATHS
@RAMPS
def test_every_pair_has_the_trapezoid_of_its_position(path, ramp):
    table = pair_table(path, ramp)
    corners = [-path.approach, -path.approach + ramp, path.recess - ramp, path.recess]
    for x in np.linspace(0.0, 1.0, 997, endpoint=False) + 1e-5:
        s, weight = weights(table, x)
        present = weight > 0.0
        candidates = x + np.arange(-PAIRS, PAIRS + 1)
        inside = candidates[(candidates > -path.approach) & (candidates < path.recess)]
        assert np.sort(s[present]) == pytest.approx(inside, abs=1e-12)
        expected = np.interp(s[present], corners, [0.0, 1.0, 1.0, 0.0]) if ramp else 1.0
        assert weight[present] == pytest.approx(expected, abs=1e-9)


@PATHS
@RAMPS
def test_mean_number_of_pairs_is_the_contact_ratio_less_the_ramp(path, ramp):
    table = pair_table(path, ramp)
    mean = 0.0
    for j in range(table.segments):
        low, high = table.edge[j], table.edge[j + 1]
        mean += (high - low) * weights(table, 0.5 * (low + high), j)[1].sum()
    assert mean == pytest.approx(path.contact_ratio - ramp, abs=1e-9)


@PATHS
def test_number_of_pairs_is_continuous_across_the_edges(path):
    table = pair_table(path, 0.03)
    for j in range(table.segments):
        ahead = (j + 1) % table.segments
        before = weights(table, table.edge[j + 1], j)[1].sum()
        after = weights(table, 0.0 if ahead == 0 else table.edge[j + 1], ahead)[1].sum()
        assert before == pytest.approx(after, abs=1e-9)


@pytest.mark.parametrize(
    "path, window", [(EXTERNAL, (-0.2008, 0.2438)), (INTERNAL, (-0.2438, -0.0531))]
)
def test_a_pair_is_alone_where_the_paths_leave_it_alone(path, window):
    table = pair_table(path, 0.0)
    alone = []
    for x in np.linspace(0.0, 1.0, 20001)[:-1]:
        s, weight = weights(table, x)
        if np.count_nonzero(weight) == 1:
            alone.append(s[weight > 0.0][0])
    assert (min(alone), max(alone)) == pytest.approx(window, abs=1.2e-4)


@pytest.mark.parametrize("path", [PathOfContact(0.6, 0.42), PathOfContact(1.6, 1.5)])
def test_contact_ratios_it_has_no_table_for_are_refused(path):
    with pytest.raises(ValueError, match="contact ratio"):
        pair_table(path, 0.03)
