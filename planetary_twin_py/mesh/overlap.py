"""Helical teeth: contact lines that move along the face.

A helical gear is a stack of thin spur gears, each turned against the one before it. The slice at
the distance z from the middle of the face is z tan(beta_b)/p_b mesh cycles ahead, with the base
helix angle beta_b and the base pitch p_b, so over the face width L the slices span the overlap
ratio eps_b = L tan(beta_b)/p_b. The stiffness of the mesh is the mean of theirs,

    k(u) = 1/L integral of k_spur(u + z tan(beta_b)/p_b) over z from -L/2 to L/2,

and so is the weight of every tooth pair (slices without coupling: Smith 1999, Gear Noise and
Vibration, ch. 4). The line of contact of a pair is the part of its face whose slices are on the
path of contact. Where it crosses the pitch point, its slices slide in both senses: so the table
has two parts of a pair, before and after the pitch point, each with its load, its part of the face
and its middle as the place of the contact.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from .._core import PAIRS, TOTAL
from ..gearset.geometry import PathOfContact
from .stiffness import StiffnessLaw
from .tooth_pairs import Along, NoRoomError, PairTable, along, pair_table, segmented

if TYPE_CHECKING:
    from scipy.interpolate import PPoly

NOTHING = 1e-9  # of a full weight: less is none
AFTER = 0.25  # added to the shift of the part of a pair after the pitch point


def overlap_ratio(face_width: float, base_helix: float, base_pitch: float) -> float:
    """Overlap ratio of helical teeth.

    Args:
        face_width: L [m].
        base_helix: helix angle on the base circle [rad].
        base_pitch: of the transverse section [m].

    Returns:
        L |tan(base_helix)|/base_pitch (ISO 21771:2007, sec. 6.5).
    """
    return face_width * abs(math.tan(base_helix)) / base_pitch


def largest_overlap(path: PathOfContact) -> float:
    """Largest overlap ratio with room for all parts of tooth pairs that are in contact at once.

    Args:
        path: path of contact of a slice.

    Returns:
        The overlap ratio, by bisection to 1e-4.
    """
    fits, crowded = 0.0, float(PAIRS)
    while crowded - fits > 1e-4:
        middle = 0.5 * (fits + crowded)
        try:
            _empty_table(_parts(path), middle, ())
            fits = middle
        except NoRoomError:
            crowded = middle
    return fits


class Part(NamedTuple):
    """Part of the path of contact, before or after the pitch point [base pitches]."""

    first: float
    last: float
    mark: float
    """Added to the shift of a pair, to distinguish its parts."""


def _parts(path: PathOfContact) -> tuple[Part, Part]:
    return Part(-path.approach, 0.0, 0.0), Part(0.0, path.recess, AFTER)


def _empty_table(parts: Sequence[Part], overlap: float, kinks: Sequence[float]) -> PairTable:
    """A table of the parts of pairs without weights, whose slices have kinks."""
    half = 0.5 * overlap
    ends = {end for part in parts for end in (part.first, part.last)}
    corners = [end + side * half for end in (*ends, *kinks) for side in (-1.0, 1.0)]
    reaches = [(part.first - half, part.last + half) for part in parts]
    return segmented(reaches, corners, [part.mark for part in parts])


class FaceMean:
    """Means over the face of a tooth pair, whose slices are pairs of spur teeth.

    Args:
        path: path of contact of a slice.
        ramp: see `pair_table`.
        overlap: overlap ratio, above 0.
        law: stiffness of a slice.
        kinks: see `pair_table`.

    Raises:
        NoRoomError: teeth overlap by more than the table has room for, see `largest_overlap`.
        ValueError: the contact ratio of a slice is below 1 + ramp, or the table has no room for so
            many faults.
    """

    def __init__(
        self,
        path: PathOfContact,
        ramp: float,
        overlap: float,
        law: StiffnessLaw,
        kinks: Sequence[float] = (),
    ) -> None:
        self._overlap = overlap
        self._slices = pair_table(path, ramp, law.strength, law.sharing, kinks)
        self._parts = _parts(path)
        ramps = -path.approach + ramp, path.recess - ramp
        self._table = _empty_table(self._parts, overlap, (*ramps, *kinks))
        self._weight = self._integral(self._slices.weight[:, :TOTAL])

    def table(self) -> PairTable:
        """Tooth pairs of the mesh.

        Returns:
            The table, with the means over the face as weights, and the middles of the parts of the
            lines of contact as places of the contacts.
        """
        table = self._table
        table.weight[:, :TOTAL] = self._tabulated(self.weights)
        table.weight[:, TOTAL] = table.weight[:, :TOTAL].sum(axis=1)
        for j, p in zip(*np.nonzero(table.present), strict=True):
            low, high = table.edge[j], table.edge[j + 1]
            pair, part = self._split(table.shift[j, p])
            ends = self._middle(np.array([low, high]) + pair, part)
            travel = float(np.round(2.0 * (ends[1] - ends[0]) / (high - low)) / 2.0)
            table.travel[j, p] = travel
            table.centre[j, p] = ends.mean() - travel * 0.5 * (low + high)
            shares = self._share_of_face(np.array([low, high]) + pair, part)
            growth = float(shares[1] - shares[0]) / (high - low)
            table.face_growth[j, p] = growth
            table.face[j, p] = shares.mean() - growth * 0.5 * (low + high)
        for places in (table.centre, table.travel):  # absent pairs: on the path, without weight
            places[:] = np.where(table.present, places, places[:, :1])
        return table

    def weights(self, s: np.ndarray, part: Part) -> np.ndarray:
        """Weight of a part of a pair.

        Args:
            s: positions of the middle of the face [base pitches], (n,).
            part: before or after the pitch point.

        Returns:
            Means over the face, (n,).
        """
        return self._mean(self._weight, s, part)

    def factors(self, function: Along) -> np.ndarray:
        """Factor on the stiffness of parts of pairs, from one on that of their slices.

        Args:
            function: factor on the stiffness of a slice over its position [base pitches].

        Returns:
            Coefficients (SEGMENTS, PAIRS, TERMS) of the means over the face, weighted by the
            stiffness of the slices.
        """
        slices = self._slices
        values = along(slices, function)
        size = values.shape[-1]
        product = np.zeros((*values.shape[:2], 2 * size - 1))
        for j, p in zip(*np.nonzero(slices.present), strict=True):
            product[j, p] = np.convolve(values[j, p], slices.weight[j, p])
        changed = self._integral(product)

        def mean(s: np.ndarray, part: Part) -> np.ndarray:
            own = self.weights(s, part)
            carries = own > NOTHING
            share = self._mean(changed, s, part) / np.where(carries, own, 1.0)
            return np.where(carries, share, function(self._middle(s, part)))

        return self._tabulated(mean)

    def _tabulated(self, function: Callable[[np.ndarray, Part], np.ndarray]) -> np.ndarray:
        """Coefficients (SEGMENTS, PAIRS, TERMS) of a function of position and part."""
        table, result = self._table, np.zeros_like(self._table.weight[:, :TOTAL])
        for part in self._parts:
            marks = np.mod(table.shift, 1.0) == part.mark
            own = table._replace(present=table.present & marks, shift=table.shift - part.mark)
            result += along(own, lambda s, part=part: function(s, part))  # type: ignore[misc]
        return result

    def _split(self, shift: float) -> tuple[float, Part]:
        """The shift of a pair and its part, from that of the table."""
        pair = math.floor(shift)
        (part,) = (part for part in self._parts if part.mark == shift - pair)
        return pair, part

    def _integral(self, coefficient: np.ndarray) -> PPoly:
        """Integral of polynomials (SEGMENTS, PAIRS, terms) of the slices over their position."""
        from scipy.interpolate import PPoly  # takes 0.3 s to load, and spur gears do not need it

        slices = self._slices
        pieces = []
        for j, p in zip(*np.nonzero(slices.present), strict=True):
            low, high = slices.edge[j] + slices.shift[j, p], slices.edge[j + 1] + slices.shift[j, p]
            pieces.append((low, high, coefficient[j, p][::-1]))
        pieces.sort(key=lambda piece: piece[0])
        edges = [piece[0] for piece in pieces] + [pieces[-1][1]]
        return PPoly(np.array([piece[2] for piece in pieces]).T, edges).antiderivative()

    def _mean(self, integral: PPoly, s: np.ndarray, part: Part) -> np.ndarray:
        low, high = self._line(s, part)
        return np.asarray((integral(high) - integral(low)) / self._overlap)

    def _middle(self, s: np.ndarray, part: Part) -> np.ndarray:
        low, high = self._line(s, part)
        return 0.5 * (low + high)

    def _share_of_face(self, s: np.ndarray, part: Part) -> np.ndarray:
        low, high = self._line(s, part)
        return np.asarray((high - low) / self._overlap)

    def _line(self, s: np.ndarray, part: Part) -> tuple[np.ndarray, np.ndarray]:
        """Positions of the slices at both ends of a part of the line of contact, from the middle of
        the face at `s`."""
        half = 0.5 * self._overlap
        low = np.clip(s - half, part.first, part.last)
        return low, np.clip(s + half, part.first, part.last)
