"""Which tooth pairs share the load of a mesh, and with what weight.

A pair enters and leaves over a short ramp: its weight rises linearly from 0 to 1 as it comes
into contact and falls back at the end. Over one mesh cycle the weights are linear between a few
breakpoints, so a mesh is a table of segments. The sum of the weights is the (fractional) number
of pairs in contact, from which the mesh stiffness follows; their ratio shares the load.
A ramp of zero is the rectangular single/double alternation of Salagianni et al. 2017, Fig. 4.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..gearset.geometry import PathOfContact

PAIRS = 3  # tooth pairs in contact at most: contact ratios up to 3
SEGMENTS = 4 * PAIRS  # breakpoints per cycle at most


class PairTable(NamedTuple):
    """Segments of the cycle of one mesh, as arrays a compiled kernel reads.

    The position s of a pair is its distance past the pitch point, in base pitches; the pairs of
    a mesh at the cycle fraction x stand at x + shift. In segment j, from edge[j] to edge[j + 1],
    pair p has the weight offset[j, p] + slope[j, p] * x.
    """

    count: int
    edge: np.ndarray  # (SEGMENTS + 1,)
    shift: np.ndarray  # (SEGMENTS, PAIRS)
    offset: np.ndarray  # (SEGMENTS, PAIRS)
    slope: np.ndarray  # (SEGMENTS, PAIRS)


def _weight(path: PathOfContact, ramp: float, s: float) -> float:
    if not -path.approach <= s <= path.recess:
        return 0.0
    if ramp == 0.0:
        return 1.0
    return min(1.0, (s + path.approach) / ramp, (path.recess - s) / ramp)


def pair_table(path: PathOfContact, ramp: float) -> PairTable:
    """Tabulate the tooth pairs of a mesh with a ramp of `ramp` base pitches.

    Raises:
        ValueError: the contact ratio is below 1 + ramp (a moment without a full pair) or above 3.
    """
    if not 1.0 + ramp <= path.contact_ratio <= PAIRS:
        raise ValueError(
            f"contact ratio = {path.contact_ratio:.4g}: must be within 1 + ramp = {1 + ramp:g} "
            f"and {PAIRS}"
        )
    kinks = (-path.approach, -path.approach + ramp, path.recess - ramp, path.recess)
    edges = sorted({0.0, 1.0} | {round(kink - math.floor(kink), 12) for kink in kinks})
    table = PairTable(
        len(edges) - 1,
        np.full(SEGMENTS + 1, 1.0),
        np.zeros((SEGMENTS, PAIRS)),
        np.zeros((SEGMENTS, PAIRS)),
        np.zeros((SEGMENTS, PAIRS)),
    )
    table.edge[: len(edges)] = edges
    for j, (low, high) in enumerate(zip(edges, edges[1:], strict=False)):
        _fill_segment(table, j, path, ramp, low, high)
    return table


def _fill_segment(
    table: PairTable, j: int, path: PathOfContact, ramp: float, low: float, high: float
) -> None:
    """Weights are linear within a segment: two inner points give them."""
    x1, x2 = low + 0.25 * (high - low), low + 0.75 * (high - low)
    pair = 0
    for shift in range(-PAIRS, PAIRS + 1):
        w1, w2 = (_weight(path, ramp, x + shift) for x in (x1, x2))
        if w1 == 0.0 and w2 == 0.0:
            continue
        slope = (w2 - w1) / (x2 - x1)
        table.shift[j, pair], table.slope[j, pair] = shift, slope
        table.offset[j, pair] = w1 - slope * x1
        pair += 1
