"""Size, start and cause of a step of the loss.

The parameters from before the step are kept, so that no filter that has adapted to a part of the
step understates it. The balances of the readings alone are compared with four causes: a change of
friction is proportional to the loss of the teeth, a change of drag has the sign of the rotation, a
change of a zero is constant, a change of a gain is proportional to the torque. They differ once
load or direction has varied. The kept parameters are uncertain: they are unknowns of each
comparison, with their covariance.

Each unknown is scaled by its standard deviation, because zeros in N m and gains differ by decades.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .balances import CAUSES, Balances

Array = NDArray[np.float64]

LONGEST = 300.0  # [s] from the detection of a step in which balances are compared
FEWEST = 20  # bins before a cause is excluded
BETTER = 6.0  # units of log-likelihood by which one cause must be better than the others
FLAT = 1e-12  # information on a cause before the step, in its own units
BEFORE = 0.005  # probability with which a step has started earlier than stated


class StepSize(NamedTuple):
    """A step of the torque balance."""

    size: float
    """[N m]."""
    sd: float
    """Its standard deviation [N m]."""
    first: int
    """Index of the balance from which it may have started."""
    likely: int
    """Index of the balance from which it most likely started."""


def size_of(balances: Balances, covariance: Array) -> StepSize:
    """Size and start of a step that has lasted until the last of some balances.

    Every start and every cause have a likelihood, for an amount that is unknown, and for errors of
    the parameters with their covariance; the result is the mean over all of them. A change of
    friction at a low torque hardly changes the balance, so its start is as uncertain as that shows.
    """
    sd, added = balances.sd, balances.added
    value, slopes = balances.value / sd, balances.slope / sd[:, None]
    added = added / np.maximum(np.sqrt(np.mean(added**2, axis=0)), 1e-300)
    shapes = added / sd[:, None]
    # Whitened readings have the covariance 1 + S P S'; its inverse is 1 - S inner S' (Woodbury).
    root = _root(covariance)
    posterior = _triangle(np.vstack([np.eye(len(root)), slopes @ root]))
    half = np.linalg.solve(posterior.T, root.T)
    inner = half.T @ half
    along = _from_each(shapes[:, :, None] * slopes[:, None, :])  # (n, causes, parameters)
    square = _from_each(shapes**2) - np.einsum("nci,ij,ncj->nc", along, inner, along)
    square = np.where(square > 0.0, square, np.inf)  # round-off: no information, so no weight
    product = _from_each(shapes * value[:, None]) - along @ inner @ (slopes.T @ value)
    amount = product / square
    score = 0.5 * product * amount - 0.5 * np.log(square)
    share = np.exp(score - score.max())
    share /= share.sum()
    mean = _from_each(added) / np.arange(len(added), 0, -1)[:, None]
    sizes = amount * mean
    size = float(np.sum(share * sizes))
    variance = float(np.sum(share * (mean**2 / square + (sizes - size) ** 2)))
    starts = share.sum(axis=1)
    first = int(np.searchsorted(np.cumsum(starts), BEFORE))
    return StepSize(size, math.sqrt(variance), first, int(np.argmax(starts)))


def _root(covariance: Array) -> Array:
    """A square root L of a covariance L L', with parameters of any units or without error."""
    sd = np.sqrt(np.diag(covariance))
    inverse = np.divide(1.0, sd, out=np.zeros_like(sd), where=sd > 0.0)
    value, vector = np.linalg.eigh(covariance * inverse * inverse[:, None])
    return np.asarray(sd[:, None] * vector * np.sqrt(np.maximum(value, 0.0)))


def _triangle(rows: Array) -> Array:
    """Rows R with R'R equal to that of `rows`, as many as there are columns."""
    return np.asarray(np.linalg.qr(rows, mode="r"))


def _from_each(values: Array) -> Array:
    """Sums from each row to the last."""
    return np.cumsum(values[::-1], axis=0)[::-1]


class StepCause:
    """Compares possible causes of a step found at `begin` [s], by the covariance before it."""

    def __init__(self, begin: float, covariance: Array, possible: tuple[str, ...] = CAUSES) -> None:
        self.begin = begin
        self._possible = np.array([cause in possible for cause in CAUSES])
        self._count = 0
        parameters, causes = len(covariance), len(CAUSES)
        self._scale = np.zeros((parameters + causes, parameters + causes))
        self._scale[:parameters, :parameters] = _root(covariance)
        self._scale[parameters:, parameters:] = np.eye(causes) / math.sqrt(FLAT)
        self._rows = np.diag([*np.ones(parameters + causes), 0.0])
        """Rows of the scaled unknowns, whose priors are 0 +- 1, and of the scores, reduced to a
        triangle: the normal equations would lose the priors beside large torques."""
        self._known = parameters

    def add(self, found: Balances) -> None:
        """Add balances since the step, with the parameters from before it."""
        rows = np.column_stack([found.slope, found.added]) @ self._scale
        rows = np.column_stack([rows, found.value]) / found.sd[:, None]
        self._rows = _triangle(np.vstack([self._rows, rows]))
        self._count += len(rows)

    @property
    def causes(self) -> tuple[str, ...]:
        """Causes that explain the balances, the most likely one first."""
        if self._count < FEWEST:
            return tuple(CAUSES[n] for n in np.flatnonzero(self._possible))
        gain = np.array([self._gain(n) for n in range(len(CAUSES))])
        gain[~self._possible] = -np.inf
        order = np.argsort(-gain, kind="stable")
        square = float(np.sum(self._rows[:, -1] ** 2))
        misfit = 2.0 * (0.5 * square - float(gain.max())) / self._count
        plausible = gain > gain.max() - BETTER * max(misfit, 1.0)
        return tuple(CAUSES[n] for n in order if plausible[n])

    def _gain(self, cause: int) -> float:
        """Gain of log-likelihood of one cause together with errors of the parameters."""
        columns = [*range(self._known), self._known + cause]
        explained = np.linalg.qr(self._rows[:, columns])[0].T @ self._rows[:, -1]
        return float(0.5 * explained @ explained)
