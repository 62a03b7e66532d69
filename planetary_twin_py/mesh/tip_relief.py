"""Tip relief and wear: missing material of flanks, and its effect on the stiffness at one load.

A relieved or worn pair p carries k_p (d - g_p) if the mesh deflection d exceeds its gap g_p. At the
mesh force F, d follows from F = sum of k_p max(d - g_p, 0) over the pairs in contact (Harris 1958,
Proc. IMechE 172; Munro 1994: relief that just relieves the pair at its change-over). The table of
tooth pairs gets the secant stiffness F/d and the load shares of the pairs at this force; the
contact compliance of `tooth.contact` is also computed at one load. At this load deflection,
transmission error and load sharing are exact. At other loads the effect of the relief scales with
the load, and frequencies of small vibration are those of the secant stiffness, which is below the
tangent.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np

from .._core import PAIRS, SEGMENTS, TERMS, TOTAL
from ..gearset.geometry import PathOfContact
from .interpolation import NODES, through
from .stiffness import StiffnessLaw
from .tooth_pairs import PairTable, pair_table, powers
from .worn import Worn

PATH_CORNERS = 6  # ends of the cycle, of the path, and of its ramps
SAMPLES = 65  # per segment; between two of them a pair comes into contact at most once
BISECTIONS = 50
SAME = 1e-9  # base pitches; closer kinks are merged
CLEAR = 1e-12  # of a mesh cycle: distance from an edge at which a segment is evaluated

Shape = Literal["linear", "parabolic"]


class Relief(NamedTuple):
    """Relief of the tip of one gear."""

    amount: float
    """Missing material at the tip, normal to the flank [m]."""
    length: float
    """Length from the tip along the line of action [base pitches]."""
    shape: Shape


class PairGap(NamedTuple):
    """Gap of a pair along its path, by relief and wear of both gears."""

    path: PathOfContact
    first: Relief | None
    """Of the gear whose tip is in contact at the end of the recess."""
    second: Relief | None
    """Of the gear whose tip is in contact at the start of the approach."""
    worn: Worn | None = None

    @property
    def kinks(self) -> tuple[float, ...]:
        """Positions at which the relief begins, and at which wear bends [base pitches]."""
        late = () if self.first is None else (self.path.recess - self.first.length,)
        early = () if self.second is None else (self.second.length - self.path.approach,)
        return late + early + (() if self.worn is None else self.worn.kinks)

    def at(self, position: np.ndarray) -> np.ndarray:
        """Missing material [m] of pairs at positions after the pitch point [base pitches]."""
        gap = np.zeros_like(position)
        if self.first is not None:
            gap += _depth(self.first, self.path.recess - position)
        if self.second is not None:
            gap += _depth(self.second, position + self.path.approach)
        return gap if self.worn is None else gap + self.worn.at(position)


def _depth(relief: Relief, from_tip: np.ndarray) -> np.ndarray:
    share = np.clip(1.0 - from_tip / relief.length, 0.0, 1.0)
    return relief.amount * (share if relief.shape == "linear" else share**2)


def relieved_table(
    gap: PairGap, ramp: float, law: StiffnessLaw, force: float, kinks: Sequence[float] = ()
) -> PairTable:
    """Table of tooth pairs with the secant stiffness of relieved teeth.

    Args:
        gap: gap of the pairs.
        ramp: see `pair_table`.
        law: stiffness of pairs without relief; its gain is above 0.
        force: mesh force [N] for stiffness and load shares.
        kinks: see `pair_table`.

    Returns:
        The table.

    Raises:
        ValueError: see `pair_table`; or the table has no room for the changes of contact.
    """
    plain = _table(gap.path, ramp, law, (*kinks, *gap.kinks))
    engaged = _changes(plain, gap, law, force)
    corners = (*kinks, *gap.kinks, *engaged)
    if len(corners) + PATH_CORNERS > SEGMENTS:
        raise ValueError(
            "mesh.tip_relief, mesh.worn: too many changes of contact in one mesh cycle"
        )
    table = _table(gap.path, ramp, law, corners)
    for j in range(table.segments):
        low, high = table.edge[j], table.edge[j + 1]
        weights = _weights(table, j, low + (high - low) * NODES, gap, law, force)
        for p in np.flatnonzero(table.present[j]):
            table.weight[j, p] = through(weights[:, p]) / powers(high - low)
        table.weight[j, TOTAL] = table.weight[j, :TOTAL].sum(axis=0)
    return table


def pair_loads_at(
    plain: PairTable, gap: PairGap, law: StiffnessLaw, force: np.ndarray, position: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Statics of pairs with gaps, from the table of pairs without them.

    Args:
        plain: pairs without gaps.
        gap: gap of the pairs.
        law: stiffness of the pairs.
        force: mesh force [N], (n,).
        position: of a pair on its path [base pitches], (n,).

    Returns:
        Loads of the pairs [N], and deflection of the mesh [m], (n,) each.
    """
    first = plain.edge[0]
    cycle = first + np.mod(position - first, 1.0)
    found, deflection = np.zeros(len(position)), np.zeros(len(position))
    edges = plain.edge[1 : plain.segments]
    for j in range(plain.segments):
        rows = np.flatnonzero(np.searchsorted(edges, cycle, side="right") == j)
        loads, deflection[rows] = _share(plain, j, cycle[rows], gap, law, force[rows])
        for p in np.flatnonzero(plain.present[j]):
            own = np.abs(position[rows] - cycle[rows] - plain.shift[j, p]) < 0.5
            found[rows[own]] = loads[own, p]
    return found, deflection


def _table(
    path: PathOfContact, ramp: float, law: StiffnessLaw, kinks: Sequence[float]
) -> PairTable:
    return pair_table(path, ramp, law.strength, law.sharing, kinks)


def _weights(
    table: PairTable, j: int, cycle: np.ndarray, gap: PairGap, law: StiffnessLaw, force: float
) -> np.ndarray:
    """Weights of the pairs (n, PAIRS) at fractions (n,) of the cycle in segment j."""
    loads, deflection = _share(table, j, cycle, gap, law, force)
    total = (force / deflection - law.base) / law.gain
    return np.asarray(total[:, None] * loads / force)


def _share(
    table: PairTable, j: int, cycle: np.ndarray, gap: PairGap, law: StiffnessLaw,
    force: float | np.ndarray,
) -> tuple[np.ndarray, np.ndarray]:  # fmt: skip
    """Loads of the pairs [N] (n, PAIRS) and deflection of the mesh [m] (n,)."""
    powers = (cycle - table.edge[j])[:, None] ** np.arange(TERMS)
    weight = powers @ table.weight[j, :PAIRS].T
    weight[:, ~table.present[j]] = 0.0
    stiffness = weight * (law.base / weight.sum(axis=1) + law.gain)[:, None]
    missing = gap.at(cycle[:, None] + table.shift[j])
    carries = stiffness > 0.0
    for _ in range(PAIRS):  # each pass drops pairs whose gap is not closed
        acting = np.where(carries, stiffness, 0.0)
        deflection = (force + (acting * missing).sum(axis=1)) / acting.sum(axis=1)
        carries &= missing < deflection[:, None]
    acting = np.where(carries, stiffness, 0.0)
    deflection = (force + (acting * missing).sum(axis=1)) / acting.sum(axis=1)
    return acting * (deflection[:, None] - missing), deflection


def _changes(table: PairTable, gap: PairGap, law: StiffnessLaw, force: float) -> list[float]:
    """Positions on the path at which pairs come into contact or leave it [base pitches]."""
    found = []
    for j in range(table.segments):
        low, high = table.edge[j] + CLEAR, table.edge[j + 1] - CLEAR
        cycle = np.linspace(low, high, SAMPLES)
        carries = _share(table, j, cycle, gap, law, force)[0] > 0.0
        for n, p in np.argwhere(carries[1:] != carries[:-1]):
            at = _bisect(table, j, int(p), (cycle[n], cycle[n + 1]), gap, law, force)
            found.append(at + float(table.shift[j, p]))
    distinct: list[float] = []
    for kink in sorted(found):
        if not distinct or kink - distinct[-1] > SAME:
            distinct.append(kink)
    return distinct


def _bisect(
    table: PairTable, j: int, p: int, ends: tuple[float, float], gap: PairGap, law: StiffnessLaw,
    force: float,
) -> float:  # fmt: skip
    """Fraction of the cycle between `ends` at which pair p comes into contact or leaves it."""
    low, high = ends
    begins = bool(_share(table, j, np.array([low]), gap, law, force)[0][0, p] > 0.0)
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        carries = bool(_share(table, j, np.array([middle]), gap, law, force)[0][0, p] > 0.0)
        low, high = (middle, high) if carries == begins else (low, middle)
    return 0.5 * (low + high)
