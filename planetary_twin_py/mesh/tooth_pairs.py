"""Tooth pairs that share the load of a mesh, and their weights.

A pair enters and leaves contact over a short ramp: its weight rises linearly from 0 to its full
strength at the start and falls to 0 at the end. Over one mesh cycle the weights are smooth between
a few breakpoints, so a mesh is a table of segments with a polynomial for every pair.
The mesh stiffness is base + gain * (sum of the weights), shared in the ratio of the weights:

- given stiffness k of one pair, every further pair adds (r - 1) k: full strength 1, and
  base = (2 - r) k, gain = (r - 1) k (r = 1.75 is the slope of ISO 6336-1, c_gamma over the contact
  ratio; a ramp of zero is the single/double alternation of Salagianni et al. 2017, Fig. 4);
- stiffness computed for every position of a pair: its strength is proportional to this stiffness,
  base = 0, gain = largest stiffness on the path. The stiffness of two pairs on one gear body is
  their sum times the factor `sharing`, which multiplies their weights.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from .._core import PAIRS, SEGMENTS, TERMS, TOTAL
from ..gearset.geometry import PathOfContact
from .interpolation import NODES, through

MOST_PAIRS = 3  # of spur teeth in contact at once
# An edge of spur teeth, because friction reverses there: at a given tolerance, steps that end there
# have down to a quarter of the error.
PITCH_POINT = 0.0


class NoRoomError(ValueError):
    """More tooth pairs, or parts of them, are in contact at once than a table has room for."""


Along = Callable[[np.ndarray], np.ndarray]  # function of positions on the path of contact


class PairTable(NamedTuple):
    """Segments of the cycle of one mesh, as arrays for the core.

    The position s of a pair is its distance past the pitch point, in base pitches; the pairs of
    a mesh at the cycle fraction x are at x + shift. In segment j, from edge[j] to edge[j + 1],
    the weight of pair p is a polynomial in x - edge[j]. The last edge is the first one of the next
    cycle.
    """

    segments: int
    edge: np.ndarray  # (SEGMENTS + 1,)
    shift: np.ndarray  # (SEGMENTS, PAIRS)
    present: np.ndarray  # (SEGMENTS, PAIRS) whether the pair exists
    weight: np.ndarray  # (SEGMENTS, PAIRS + 1, TERMS), the sum over the pairs at TOTAL
    # The contact of a pair is at centre + travel * x: in the middle of its contact line, which in
    # spur teeth is the position of the pair.
    centre: np.ndarray  # (SEGMENTS, PAIRS)
    travel: np.ndarray  # (SEGMENTS, PAIRS)
    # It is on the part face + face_growth * x of the face: on all of spur teeth.
    face: np.ndarray  # (SEGMENTS, PAIRS)
    face_growth: np.ndarray  # (SEGMENTS, PAIRS)


def one(s: np.ndarray) -> np.ndarray:
    """Strength of a pair with a given constant stiffness."""
    return np.ones_like(s)


def pair_table(
    path: PathOfContact,
    ramp: float,
    strength: Along = one,
    sharing: float = 1.0,
    kinks: Sequence[float] = (),
) -> PairTable:
    """Tabulate the tooth pairs of a mesh with a ramp of `ramp` base pitches.

    Args:
        path: path of contact.
        ramp: length [base pitches] over which the weight of a pair rises and falls.
        strength: full weight of a pair over its position [base pitches].
        sharing: factor on the weights of two pairs in simultaneous contact.
        kinks: further positions on the path with a discontinuity or a kink.

    Raises:
        ValueError: the contact ratio is below 1 + ramp (an instant without a full pair) or above 3.
    """
    if not 1.0 + ramp <= path.contact_ratio <= MOST_PAIRS:
        raise ValueError(
            f"contact ratio = {path.contact_ratio:.4g}: must be within 1 + ramp = {1 + ramp:g} "
            f"and {MOST_PAIRS}"
        )
    ends = (-path.approach, -path.approach + ramp, path.recess - ramp, path.recess)
    kinks = [kink for kink in kinks if -path.approach < kink < path.recess]
    table = segmented([(-path.approach, path.recess)], (*ends, PITCH_POINT, *kinks))
    table.weight[:, :TOTAL] = along(
        table,
        lambda s: _ramp(path, ramp, s) * strength(s) * _shared(path, ramp, sharing, s),
    )
    table.weight[:, TOTAL] = table.weight[:, :TOTAL].sum(axis=1)
    return table


def segmented(
    reaches: Sequence[tuple[float, float]],
    corners: Sequence[float],
    marks: Sequence[float] = (0.0,),
) -> PairTable:
    """A table of pairs without weights.

    Args:
        reaches: positions at which a pair, or each part of it, comes into contact and leaves it
            [base pitches].
        corners: positions with a discontinuity or a kink.
        marks: added to the shifts of each part of a pair, below 1.

    Returns:
        Segments between the corners, and the pairs that are in contact in each.

    Raises:
        NoRoomError: the table has no room for the pairs.
        ValueError: it has no room for the corners.
    """
    edges = sorted({round(corner % 1.0, 12) % 1.0 for corner in corners})
    edges.append(edges[0] + 1.0)
    if len(edges) > SEGMENTS:
        raise ValueError(
            f"faults: teeth have room for {SEGMENTS} changes of stiffness in a mesh cycle, and "
            f"these make {len(edges)}: give fewer spalls"
        )
    table = PairTable(
        len(edges) - 1,
        np.full(SEGMENTS + 1, edges[-1]),
        np.zeros((SEGMENTS, PAIRS)),
        np.zeros((SEGMENTS, PAIRS), dtype=bool),
        np.zeros((SEGMENTS, PAIRS + 1, TERMS)),
        np.zeros((SEGMENTS, PAIRS)),
        np.ones((SEGMENTS, PAIRS)),
        np.ones((SEGMENTS, PAIRS)),
        np.zeros((SEGMENTS, PAIRS)),
    )
    table.edge[: len(edges)] = edges
    for j, (low, high) in enumerate(pairwise(edges)):
        middle = 0.5 * (low + high)
        shifts = [
            n + mark
            for n in range(-PAIRS, PAIRS + 1)
            for (first, last), mark in zip(reaches, marks, strict=True)
            if first < middle + n < last
        ]
        if len(shifts) > PAIRS:
            raise NoRoomError(
                f"{len(shifts)} parts of tooth pairs are in contact at once: at most {PAIRS}"
            )
        table.shift[j] = shifts[0]  # absent pairs have a position but no weight
        table.shift[j, : len(shifts)] = shifts
        table.present[j, : len(shifts)] = True
    table.centre[:] = table.shift
    return table


def _shared(path: PathOfContact, ramp: float, sharing: float, s: np.ndarray) -> np.ndarray:
    """Factor on the weight of a pair at `s` by other pairs on the same gear body."""
    others = [n for n in range(-MOST_PAIRS, MOST_PAIRS + 1) if n != 0]
    count = sum(np.clip(_ramp(path, ramp, s + n), 0.0, 1.0) for n in others)
    return 1.0 + (sharing - 1.0) * count


def _ramp(path: PathOfContact, ramp: float, s: np.ndarray) -> np.ndarray:
    if ramp == 0.0:
        return np.where((-path.approach <= s) & (s <= path.recess), 1.0, 0.0)
    return np.minimum(1.0, np.minimum(s + path.approach, path.recess - s) / ramp)


def along(table: PairTable, function: Along) -> np.ndarray:
    """Coefficients (SEGMENTS, PAIRS, TERMS) of a function of the position of a pair.

    Interpolates at the Chebyshev points of each segment: exact for a polynomial with as many
    terms that has its breakpoints at edges.
    """
    result = np.zeros((SEGMENTS, PAIRS, TERMS))
    j, _ = place = np.nonzero(table.present)
    low, length = table.edge[j, None], np.diff(table.edge)[j, None]
    s = low + length * NODES + table.shift[place][:, None]
    result[place] = through(function(s.ravel()).reshape(s.shape)) / powers(length)
    return result


def powers(length: float | np.ndarray) -> np.ndarray:
    """Powers 0, 1, 2, ... of lengths (..., 1), (..., TERMS)."""
    ones = np.ones((*np.shape(length)[:-1], TERMS))
    ones[..., 1:] = length
    return np.cumprod(ones, axis=-1)


def terms_in_use(table: PairTable) -> int:
    """Number of coefficients that exceed rounding in any weight."""
    lengths = np.diff(table.edge)[:, None, None]
    sizes = np.abs(table.weight * lengths ** np.arange(TERMS))
    largest = sizes.max(axis=(0, 1))
    return max(2, int(np.max(np.nonzero(largest > 1e-12 * largest.max()))) + 1)


def mean_weight(edge: np.ndarray, weight: np.ndarray) -> float:
    """Mean over the mesh cycle of a weight (SEGMENTS, TERMS) with `edge` (SEGMENTS + 1,)."""
    power = np.arange(1, TERMS + 1)
    return float((weight * np.diff(edge)[:, None] ** power / power).sum())
