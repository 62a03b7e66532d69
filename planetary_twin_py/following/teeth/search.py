"""Finds the teeth that explain a residual: orthogonal matching pursuit over all teeth (Pati,
Rezaiifar and Krishnaprasad 1993, 27th Asilomar Conf., 40-44), with a joint fit of those found.

A joint fit of all teeth would be several times noisier.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..arrival.bins import NORMAL
from .scores import Bank

Array = NDArray[np.float64]

ALARM = 6.5  # standard deviations above which the first tooth is found
FURTHER = 5.0  # standard deviations above which a further tooth is found
SHARE = 0.3  # of the first one, below which a further one may be a misfit of the first: signatures
# of wear and of a crack correlate by 0.97, so each leaves a quarter of the other as residual
KEPT = 3.0  # standard deviations below which a tooth is removed from the joint fit
SIMILAR = 3.0  # units of log-likelihood within which teeth cannot be distinguished
MOST = 6  # teeth that are found at most


class Residual(NamedTuple):
    """Sum of the residuals of some blocks."""

    total: Array
    """[m], (cycles, BINS)."""
    blocks: Array
    """Number of blocks in the sum, (cycles, BINS)."""
    sd: Array
    """Standard deviation of the loss of each tooth alone, at the torque of the bank, (teeth,)."""


class Found(NamedTuple):
    """A tooth that explains a part of a residual."""

    tooth: int
    """Index in the bank."""
    amount: float
    """Amount of its signature of unit loss, at the torque of the bank."""
    sd: float
    """Standard deviation of the amount."""
    z: float
    """Amount of this tooth alone in standard deviations, with the other found teeth subtracted."""
    candidates: tuple[int, ...]
    """Teeth that explain it equally well, including this one, the best first."""


def find_teeth(bank: Bank, residual: Residual) -> list[Found]:
    """Teeth that explain a residual, the most certain one first; empty if none is significant."""
    residual = _with_noise(bank, residual)
    active: list[int] = []
    remainder, limit = residual.total, ALARM
    while len(active) < MOST:
        z = _significance(bank, remainder, residual)
        z[active] = -np.inf
        best = int(np.argmax(z))
        if z[best] < limit:
            break
        if not active:
            limit = max(FURTHER, SHARE * float(z[best]))
        active.append(best)
        remainder = _subtract(bank, residual, active, _fit(bank, residual, active)[0])
    while active:
        amounts, sds = _fit(bank, residual, active)
        weak = int(np.argmin(amounts / sds))
        if amounts[weak] >= KEPT * sds[weak]:
            break
        del active[weak]
    if not active:
        return []
    return sorted(_with_similar(bank, residual, active), key=lambda match: -match.z)


def _with_noise(bank: Bank, residual: Residual) -> Residual:
    """The residual with at least the scatter of its teeth after the best one is subtracted.

    Few teeth change, so the median over all teeth gives the noise. Blocks may be noisier than those
    of the baseline.
    """
    strongest = int(np.argmax(_significance(bank, residual.total, residual)))
    remainder = _subtract(bank, residual, [strongest], _fit(bank, residual, [strongest])[0])
    spread = NORMAL * float(np.median(np.abs(_significance(bank, remainder, residual))))
    return residual._replace(sd=residual.sd * max(1.0, spread))


def _with_similar(bank: Bank, residual: Residual, active: list[int]) -> list[Found]:
    """Each tooth with its similar ones, of which the best one replaces it."""
    cycles = len(residual.total)
    amounts, sds = _fit(bank, residual, active)
    remainder = _subtract(bank, residual, active, amounts)
    matches = []
    for tooth, amount, sd in zip(active, amounts, sds, strict=True):
        tooth_residual = remainder + residual.blocks * amount * bank.deviation(tooth, cycles)
        z = _significance(bank, tooth_residual, residual)
        z[[other for other in active if other != tooth]] = -np.inf
        order = np.argsort(-z, kind="stable")
        gains = 0.5 * np.maximum(z[order], 0.0) ** 2
        similar = tuple(int(t) for t in order[gains >= gains[0] - SIMILAR])
        matches.append(Found(similar[0], float(amount), float(sd), float(z[similar[0]]), similar))
    return matches


def _significance(bank: Bank, remainder: Array, residual: Residual) -> Array:
    product, square = bank.score(remainder, residual.blocks)
    return np.asarray(product / np.maximum(square, 1e-300) / residual.sd)


def _fit(bank: Bank, residual: Residual, active: list[int]) -> tuple[Array, Array]:
    """Joint least squares: amounts and their standard deviations, (active,) each."""
    rows = np.array([bank.deviation(t, len(residual.total)).ravel() for t in active])
    weighted = rows * residual.blocks.ravel()
    gram = weighted @ rows.T
    inverse = np.linalg.inv(gram)
    widening = np.sqrt(np.diag(inverse) * np.diag(gram))
    return inverse @ (rows @ residual.total.ravel()), residual.sd[active] * widening


def _subtract(bank: Bank, residual: Residual, active: list[int], amounts: Array) -> Array:
    explained = sum(
        amount * bank.deviation(t, len(residual.total))
        for t, amount in zip(active, amounts, strict=True)
    )
    return np.asarray(residual.total - residual.blocks * explained)
