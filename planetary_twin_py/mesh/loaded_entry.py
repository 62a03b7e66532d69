"""Entry of loaded teeth: pairs that touch before their path of contact begins, and after it ends.

Teeth bent by load close the separation of the next pair before its path begins, and keep the last
one closed after its path ends (Harris 1958; Seager 1967; Munro, Morrish and Palmer 1999). So a pair
takes up its load gradually over the way on which the deflection exceeds its separation, without any
given ramp. At the mesh force F the deflection d follows from

F = sum over pairs of w_p s_p (base/W + gain) max(d - g_p, 0),  W = sum of w_p s_p e_p,

with gaps g_p by separation and relief, weights w_p of the stiffness law, the deflection e_p of a
pair over the largest one, and s_p = 1 + (sharing - 1)(sum of e of the other pairs): pairs that just
touch change nothing, and pairs without gaps have the stiffness of `tooth_pairs`. Off its path a
pair has the stiffness at the end of its path.

The table gets the secant stiffness F/d and the load shares at this force, as that of tip relief: at
this force deflection, transmission error and load sharing are exact. At another force the table
stays, so entry is too long below it and too short above it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from .._core import TOTAL
from ..gearset.geometry import PathOfContact
from .interpolation import NODES, through
from .stiffness import StiffnessLaw
from .tooth_pairs import MOST_PAIRS, PITCH_POINT, Along, PairTable, powers, segmented

NEIGHBOURS = np.arange(-MOST_PAIRS, MOST_PAIRS + 1)  # pairs of which some may be in contact
FURTHEST = 0.5  # base pitches off the path up to which teeth may touch
SEARCHED = 801  # positions at which changes of contact are looked for
TINY = 1e-11  # [base pitches]
FAR = 1.0  # [m], in place of an infinite gap
BISECTIONS = 52  # of the deflection: all bits of its mantissa
SMALL = 1e-12  # relative, so that nothing is divided by 0


class Entry(NamedTuple):
    """Tooth pairs that touch where a load closes their gap."""

    path: PathOfContact
    gap: Along
    """Distance of the flanks [m] over the position of a pair [base pitches], infinite where they
    cannot touch."""
    law: StiffnessLaw
    force: float | np.ndarray
    """Mesh force of stiffness and load shares [N], one or (n,) of n positions."""

    def loads(self, cycle: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Statics of the pairs.

        Args:
            cycle: position of a pair [base pitches], modulo 1, (n,).

        Returns:
            Loads of the pairs at `cycle` + `NEIGHBOURS` [N], (n, pairs), and deflection of the mesh
            [m], (n,).
        """
        position = cycle[:, None] + NEIGHBOURS
        gap = self.gap(position)
        nearest = np.clip(position, -self.path.approach, self.path.recess)
        weight = self.law.strength(nearest.ravel()).reshape(position.shape)
        low = gap.min(axis=1)
        high = low + 2.0 * self.force / (self.law.gain * weight[weight > 0.0].min())
        for _ in range(BISECTIONS):
            middle = 0.5 * (low + high)
            enough = self._carried(weight, gap, middle).sum(axis=1) >= self.force
            low, high = np.where(enough, low, middle), np.where(enough, middle, high)
        deflection = 0.5 * (low + high)
        loads = self._carried(weight, gap, deflection)
        return loads * (self.force / loads.sum(axis=1))[:, None], deflection

    def _carried(self, weight: np.ndarray, gap: np.ndarray, deflection: np.ndarray) -> np.ndarray:
        """Loads of pairs at a deflection of the mesh [N], (n, pairs)."""
        bent = np.maximum(deflection[:, None] - gap, 0.0)
        part = bent / np.maximum(bent.max(axis=1), SMALL * self.force / self.law.single)[:, None]
        others = part.sum(axis=1)[:, None] - part
        shared = weight * (1.0 + (self.law.sharing - 1.0) * others)
        whole = np.maximum((shared * part).sum(axis=1), SMALL)[:, None]
        return np.asarray(shared * (self.law.base / whole + self.law.gain) * bent)

    def margin(self, position: np.ndarray) -> np.ndarray:
        """Deflection of the mesh less the gap of a pair [m], above 0 where it carries load, (n,).

        Args:
            position: of the pair [base pitches], (n,).
        """
        return np.asarray(self.loads(position)[1] - np.minimum(self.gap(position), FAR))


def entry_table(entry: Entry, kinks: Sequence[float] = ()) -> PairTable:
    """Table of tooth pairs that come into contact under load.

    Args:
        entry: the pairs.
        kinks: positions on the path with a discontinuity or a kink [base pitches].

    Returns:
        The table.

    Raises:
        ValueError: the load closes the gaps of more pairs than a mesh has, or the table has no
            room for the changes of contact.
    """
    changes = _changes(entry)
    first, last = changes[0], changes[-1]
    if last - first > MOST_PAIRS:
        raise ValueError(
            f"contact ratio under load = {last - first:.4g}: must be at most {MOST_PAIRS}"
        )
    path = entry.path
    within = [kink for kink in (*kinks, -path.approach, path.recess) if first < kink < last]
    table = segmented([(first, last)], (*changes, PITCH_POINT, *within))
    law = entry.law
    for j in range(table.segments):
        low, high = table.edge[j], table.edge[j + 1]
        cycle = low + (high - low) * NODES
        loads, deflection = entry.loads(cycle)
        total = (entry.force / deflection - law.base) / law.gain
        weights = total[:, None] * loads / entry.force
        for p in np.flatnonzero(table.present[j]):
            values = weights[:, MOST_PAIRS + round(float(table.shift[j, p]))]
            table.weight[j, p] = through(values) / powers(high - low)
        table.weight[j, TOTAL] = table.weight[j, :TOTAL].sum(axis=0)
    return table


def _changes(entry: Entry) -> list[float]:
    """Positions at which a pair comes into contact or leaves it [base pitches]."""
    from scipy.optimize import brentq  # takes time to load, and few scenes need it

    ends = -entry.path.approach - FURTHEST, entry.path.recess + FURTHEST
    position = np.linspace(*ends, SEARCHED)
    touches = entry.margin(position) > 0.0
    found = [
        float(brentq(_margin_at, position[n], position[n + 1], args=(entry,), xtol=TINY))
        for n in np.flatnonzero(touches[1:] != touches[:-1])
    ]
    if touches[0] or touches[-1] or len(found) < 2:
        raise ValueError(
            f"mesh.entry = 'loaded': the load bends teeth over more than {FURTHEST:g} base pitches "
            "off their path: reduce the torque, or check gearset.face_width and gearset.module"
        )
    return [round(each, 9) for each in found]


def _margin_at(position: float, entry: Entry) -> float:
    return float(entry.margin(np.array([position]))[0])
