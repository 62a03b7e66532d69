"""Load shares of the planets over mesh cycles: means without the ripple of the tooth pairs.

Errors that turn with the gears change the shares from cycle to cycle. Over a turn their mean is
even, so the load sharing factor is that of the cycle in which a planet carries most.
"""

from __future__ import annotations

import math

import numpy as np

LEAST = 32  # samples in the mean of a cycle: a ripple of 0.3 then changes it by about 0.01
LOADED = 0.5  # of the mean load: shares of cycles with less are not those that load the teeth


class CycleShares:
    """Sums of the loads of the planets over the mesh cycles of a run."""

    def __init__(self, planets: int) -> None:
        self._sums = np.zeros((planets, 0))
        self._time = np.zeros(0)  # in sample periods
        self._start, self._passed = math.nan, 0.0
        self._last = np.zeros((0, 1 + planets))

    def add(self, cycles: np.ndarray, load: np.ndarray) -> None:
        """Add samples at equal distances in time; cycles with one that is NaN are left out.

        Args:
            cycles: mesh cycles from any start, (samples,).
            load: loads of the planets, in any unit, (samples, planets).
        """
        samples = np.concatenate([self._last, np.column_stack([cycles, load])])
        if not len(samples):
            return
        self._last = samples[-1:]
        known = np.isfinite(samples[:, 0])
        if not known.any():
            return
        if math.isnan(self._start):
            self._start = float(samples[known][0, 0])
        passed = np.abs(samples[:, 0] - self._start)
        self._passed = max(self._passed, float(passed[known].max()))
        mean = 0.5 * (samples[:-1, 1:] + samples[1:, 1:])
        mean[~(known[:-1] & known[1:])] = math.nan  # in the cycle of the end that is known
        placed = known[:-1] | known[1:]
        begin = np.fmin(passed[:-1], passed[1:])[placed]
        end, mean = np.fmax(passed[:-1], passed[1:])[placed], mean[placed]
        first, last = begin.astype(int), end.astype(int)
        # Part of the interval between two samples that is in the later of two cycles.
        later = np.divide(end - last, end - begin, out=np.zeros_like(end), where=last > first)
        self._put(first, 1.0 - later, mean)
        self._put(last, later, mean)

    def _put(self, cycle: np.ndarray, time: np.ndarray, load: np.ndarray) -> None:
        room = max(len(self._time), int(cycle.max(initial=-1)) + 1)
        more = room - len(self._time)
        self._time = np.pad(self._time, (0, more)) + np.bincount(cycle, time, room)
        summed = [np.bincount(cycle, time * column, room) for column in load.T]
        self._sums = np.pad(self._sums, ((0, 0), (0, more))) + np.array(summed)

    def largest(self) -> np.ndarray | None:
        """Largest share of each planet, of means over a mesh cycle, (planets,).

        Of means over as many cycles as have `LEAST` samples, if one has fewer. None before a cycle
        is complete, or without load.
        """
        intervals = max(float(self._time.sum()), 1.0)
        whole = int(self._passed * (1.0 + 1.5 / intervals))  # up to a sample after the last
        together = max(math.ceil(LEAST * self._passed / intervals), 1)
        groups = min(whole, len(self._time)) // together
        if not groups:
            return None
        load, time = (
            values[..., : groups * together].reshape(*values.shape[:-1], groups, together).sum(-1)
            for values in (self._sums, self._time)
        )
        # Without cycles with NaN: a mean over a part of one contains the ripple.
        whole_ones = (time > 0.0) & np.isfinite(load).all(axis=0)
        means = load[:, whole_ones] / time[whole_ones]
        if not means.size:
            return None
        of_all = means.mean(axis=0)
        loaded = np.abs(of_all) > LOADED * abs(of_all.mean())
        if not loaded.any():
            return None
        return np.asarray((means[:, loaded] / of_all[loaded]).max(axis=1))
