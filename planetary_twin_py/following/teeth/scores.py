"""Scores of all teeth: the amount of each signature in a deviation.

e_j = s_j r / s_j s_j over the measured bins is the least-squares estimate of the loss of tooth j
alone. All teeth of a gear are scored at once: the deviation is folded to the period of the gear,
and correlated with the signature of tooth 0 over whole mesh cycles.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .signatures import Signatures

Array = NDArray[np.float64]


class Tooth(NamedTuple):
    """A tooth of a gear."""

    gear: str
    """"sun", "planet_1", ..., "ring"."""
    number: int
    """Number of the tooth; tooth 0 meets planet 1 first after the encoders start."""

    def __str__(self) -> str:
        return f"{self.gear} tooth {self.number}"


class Bank:
    """Signatures of all teeth of a train."""

    def __init__(self, found: Signatures) -> None:
        self.gears = found.gears
        self.torque, self.compliance = found.torque, found.compliance
        self.teeth = [Tooth(g, t) for g, s in self.gears.items() for t in range(len(s))]
        self.gear_of = np.repeat(np.arange(len(self.gears)), [len(s) for s in self.gears.values()])
        """Index of the gear of every tooth, (teeth,)."""
        self._spectra = {
            gear: (np.conj(np.fft.rfft(s, axis=0)), np.conj(np.fft.rfft(s**2, axis=0)))
            for gear, s in self.gears.items()
        }

    def score(self, deviation: Array, measured: Array | NDArray[np.bool_]) -> tuple[Array, Array]:
        """Scalar products s_j r of a deviation with signatures, and s_j s_j [m^2], (teeth,).

        The deviation [m] is 0 where not `measured`, a mask or numbers of blocks, (cycles, BINS).
        """
        products: list[Array] = []
        squares: list[Array] = []
        weight = measured.astype(float)
        for gear, signature in self.gears.items():
            teeth = len(signature)
            signature_spectrum, square_spectrum = self._spectra[gear]
            folded = deviation.reshape(-1, teeth, deviation.shape[1]).sum(axis=0)
            folded_weight = weight.reshape(-1, teeth, deviation.shape[1]).sum(axis=0)
            for results, spectrum, values in (
                (products, signature_spectrum, folded),
                (squares, square_spectrum, folded_weight),
            ):
                shifted = np.fft.irfft(np.fft.rfft(values, axis=0) * spectrum, teeth, axis=0)
                results.append(shifted.sum(axis=1))
        return np.concatenate(products), np.concatenate(squares)

    def deviation(self, tooth: int, cycles: int) -> Array:
        """Signature over a hunting period, per unit of stiffness loss [m], (cycles, BINS)."""
        gear, number = self.teeth[tooth]
        signature = np.roll(self.gears[gear], number, axis=0)
        return np.tile(signature, (cycles // len(signature), 1))
