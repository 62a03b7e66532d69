"""Entry of loaded teeth: pairs that touch before their path of contact begins, and after it ends.

Teeth bent by load close the separation of the next pair before its path begins, and keep the last
one closed after its path ends (Harris 1958; Seager 1967; Munro, Morrish and Palmer 1999). So a pair
takes up its load gradually, without any given ramp. The loads F_p of the pairs and the deflection d
of the mesh follow from the mesh force F,

F = sum of F_p,   F_p >= 0,   d <= g_p + c_p F_p + sum over its neighbours q of c_pq F_q,

with equality where F_p > 0. The gap g_p is that of separation and relief, c_p the compliance of
the pair alone. Neighbours stand on common gear bodies: the load of one moves the other, which
touches later by that. Their coupling c_pq = rho sqrt(c_p c_q) has the rho at which two equal pairs
without gaps have the stiffness of `tooth_pairs`. Off its path a tip is in contact: the pair has the
compliance, the curvatures and the sliding of the end of its path.

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
from .tooth_pairs import PITCH_POINT, Along, PairTable, powers, segmented

AWAY = 4  # base pitches from the pitch point: further pairs are not in contact
NEIGHBOURS = np.arange(-AWAY, AWAY + 1)  # pairs of which some may be in contact
MOST_LOADED = 5  # of them in contact at once
FURTHEST = 0.8  # base pitches off the path up to which teeth may touch
SEARCHED = 801  # positions at which changes of contact are looked for
_SHARED = 257  # positions at which load shares are compared
TINY = 1e-11  # [base pitches]
FAR = 1.0  # [m], in place of an infinite gap


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
        near = np.isfinite(gap)
        compliance = self._compliance(position)
        loads, deflection = self._loads(compliance, gap, near)
        for _ in range(NEIGHBOURS.size):
            lightest = loads.argmin(axis=1)
            pulled = loads.min(axis=1) < 0.0
            if not pulled.any():
                break
            near[pulled, lightest[pulled]] = False
            loads[pulled], deflection[pulled] = self._loads(
                compliance[pulled], gap[pulled], near[pulled]
            )
        return loads, deflection

    def _compliance(self, position: np.ndarray) -> np.ndarray:
        """Compliances of the pairs at positions (n, pairs) [m/N], (n, pairs, pairs)."""
        nearest = np.clip(position, -self.path.approach, self.path.recess)
        strength = self.law.strength(nearest.ravel()).reshape(position.shape)
        own = np.sqrt(1.0 / (self.law.base + self.law.gain * strength))
        return np.asarray(own[:, :, None] * own[:, None, :] * _coupling(self.law))

    def _loads(
        self, compliance: np.ndarray, gap: np.ndarray, carries: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Loads [N] (n, pairs) and deflection [m] (n,) if the pairs that carry stay together."""
        count, pairs = gap.shape
        scale = 1.0 / self.law.single
        both = carries[:, :, None] & carries[:, None, :]
        matrix = np.zeros((count, pairs + 1, pairs + 1))
        matrix[:, :pairs, :pairs] = np.where(both, compliance / scale, np.eye(pairs))
        matrix[:, :pairs, pairs] = np.where(carries, -1.0, 0.0)
        matrix[:, pairs, :pairs] = carries
        right = np.zeros((count, pairs + 1, 1))
        right[:, :pairs, 0] = np.where(carries, -gap / (scale * self.force), 0.0)
        right[:, pairs] = 1.0
        found = np.linalg.solve(matrix, right)[:, :, 0] * self.force
        return found[:, :pairs], found[:, pairs] * scale

    def margin(self, position: np.ndarray) -> np.ndarray:
        """Approach of a pair under its own load [m], (n,); where it carries none, minus its gap.

        Args:
            position: of the pair [base pitches], (n,).
        """
        pair = np.floor(position).astype(int)
        own = np.arange(len(pair)), AWAY + pair
        cycle = position - pair
        loads, deflection = self.loads(cycle)
        others = self._compliance(cycle[:, None] + NEIGHBOURS)[own]
        others[own] = 0.0
        gap = np.minimum(self.gap(position), FAR)
        return np.asarray(deflection - gap - (others * loads).sum(axis=1))

    def error_of_shares(self, force: float) -> float:
        """Largest error of the load share of a pair at another mesh force than that of the table.

        Args:
            force: mesh force, above 0 [N].
        """
        cycle = np.linspace(0.0, 1.0, _SHARED)
        there = self._replace(force=force).loads(cycle)[0] / force
        return float(np.abs(self.loads(cycle)[0] / self.force - there).max())


def _coupling(law: StiffnessLaw) -> np.ndarray:
    """Compliances of pairs and of their neighbours, over those of pairs alone, (pairs, pairs)."""
    rho = 2.0 * law.single / (law.base + 2.0 * law.gain * law.sharing) - 1.0
    beside = np.abs(NEIGHBOURS[:, None] - NEIGHBOURS) == 1
    return np.eye(NEIGHBOURS.size) + rho * beside


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
    if last - first > MOST_LOADED:
        raise ValueError(
            f"contact ratio under load = {last - first:.4g}: must be at most {MOST_LOADED}"
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
            values = weights[:, AWAY + round(float(table.shift[j, p]))]
            table.weight[j, p] = through(values) / powers(high - low)
            off = table.shift[j, p] + 0.5 * (low + high)
            end = min(max(off, -path.approach), path.recess)
            if off != end:  # the tip stays in contact, at the end of the path
                table.centre[j, p], table.travel[j, p] = end, 0.0
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
