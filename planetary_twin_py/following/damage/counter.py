"""Counts the damage of real gearboxes from their measured torque, speed and oil temperature."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...durability.damage_state import (
    DamageState,
    OilTemperature,
    Readings,
    Replacement,
    Times,
)
from ...durability.passages import passages_per_turn, whole_passages
from ...durability.sums import stacked
from ...scene import Scene
from ..train import followed_train
from .rows import RowKeeper, Rows
from .shaft_cycles import ShaftCycles
from .since_start import SinceStart

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

NODES = math.sqrt(3.0) * np.array([0.0, -1.0, 1.0])
WEIGHTS = np.array([4.0, 1.0, 1.0]) / 6.0
"""Three nodes of Gauss and Hermite: the mean over a normal torque, to the fifth moment. To second
order in s, the standard deviation over the mean, that of T^p is 1 + p(p - 1) s^2/2."""


class Rates(Protocol):
    """Rates of damage over torque, speed and temperature, see `lifetime.damage_map`."""

    @property
    def parts(self) -> tuple[str, ...]:
        """Names of the parts."""

    def outside(self, torque: ArrayLike, speed: ArrayLike, temperature: ArrayLike) -> Mask:
        """Whether an operating point is not covered, (...)."""

    def rates(self, torque: ArrayLike, speed: ArrayLike, temperature: ArrayLike) -> Array:
        """Miner sums over time [1/s], (..., parts)."""


class DamageCounter:
    """Adds readings to the damage of some gearboxes of one type.

    A reading counts for the time since the one before. The same readings give the same sums to the
    last bit, however they are split into blocks, and across files.

    Args:
        scene: scene of the type.
        rates: map of its damage.
        states: damage of each gearbox so far; they are continued in place.
        usual: usual time between readings [s]; None: as the readings have it.
    """

    def __init__(
        self,
        scene: Scene,
        rates: Rates,
        states: Sequence[DamageState],
        usual: float | None = None,
    ) -> None:
        train = followed_train(scene)
        self.rates = rates
        self._states = tuple(states)
        self.since_start = SinceStart.of(len(self._states), len(rates.parts))
        """Findings on each gearbox since the start."""
        last = [state.last for state in self._states]
        self._keeper = RowKeeper(train.ratio, train.oil_temperature, last, usual)
        self._per_turn = passages_per_turn(scene, train.cycles)
        self._shafts = ShaftCycles(scene, train.ratio)
        self._highest = self._first_outside = np.zeros(0)
        self._counts = np.zeros((3, 0), dtype=np.int64)
        self._load()

    def state(self, gearbox: int = 0) -> DamageState:
        """Damage of a gearbox now."""
        self._store(gearbox, self._states[gearbox])
        return self._states[gearbox]

    def replace_part(self, name: str, gearbox: int = 0) -> tuple[Replacement, ...]:
        """Set the damage of a part to 0, see `DamageState.replace_part`."""
        entries = self.state(gearbox).replace_part(name)
        self._load()
        return entries

    def add(self, time: Array, columns: Mapping[str, Array]) -> None:
        """Add readings in order.

        Args:
            time: stamps [s], (m,).
            columns: readings in SI by channel, and `input_torque_std`, (m, n) each; NaN where one
                is missing.
        """
        if not len(time):
            return
        rows = self._keeper.take(time, columns)
        scatter = np.where(np.isfinite(rows.torque_sd), np.abs(rows.torque_sd), 0.0)
        reach = np.abs(rows.torque) + NODES.max() * scatter
        beyond, at = np.zeros_like(rows.known), rows.known
        beyond[at] = self.rates.outside(reach[at], rows.speed[at], rows.oil[at])
        rates = np.zeros((*beyond.shape, len(self.rates.parts)))
        beyond |= self._fill(rates, rows, scatter, rows.known & ~beyond)
        counted = rows.known & ~beyond
        self._sum(rows, counted, beyond, rates, columns)
        self.since_start.note(rows, counted, beyond, reach, rates)

    def _fill(self, rates: Array, rows: Rows, scatter: Array, which: Mask) -> Mask:
        """Fill the rates of rows; returns those for which the map has none, as a run fails."""
        failed = np.zeros_like(which)
        try:
            rates[which] = self._means(rows, scatter, which)
        except ValueError as reason:
            if which.sum() == 1:
                self.since_start.refusal = self.since_start.refusal or str(reason)
                return which
            for place in np.argwhere(which):
                alone = np.zeros_like(which)
                alone[tuple(place)] = True
                failed |= self._fill(rates, rows, scatter, alone)
        return failed

    def _means(self, rows: Rows, scatter: Array, which: Mask) -> Array:
        """Rates of rows [1/s], (rows, parts): means over the torques within each."""
        torque, speed, oil = rows.torque[which], rows.speed[which], rows.oil[which]
        found = np.array(self.rates.rates(torque, speed, oil))
        wide = scatter[which] > 0.0
        if wide.any():
            sd, at = scatter[which][wide], (speed[wide], oil[wide])
            low, high = (self.rates.rates(torque[wide] + x * sd, *at) for x in NODES[1:])
            found[wide] = WEIGHTS[0] * found[wide] + WEIGHTS[1] * (low + high)
        return found

    def _sum(
        self,
        rows: Rows,
        counted: Mask,
        beyond: Mask,
        rates: Array,
        columns: Mapping[str, Array],
    ) -> None:
        """Add the terms of all rows."""
        times = [np.where(which, rows.step, 0.0) for which in (counted, rows.gap, beyond)]
        terms = rates * times[0][..., None]
        output = columns.get("output_torque", np.full(rows.torque.shape, math.nan))
        self._shafts.add(rows, output, self.rates.parts, terms)
        self._damage.add(terms)
        self._times.add(np.stack(times, axis=-1))
        turns = np.where(counted, np.abs(rows.speed), 0.0) / (2.0 * math.pi) * times[0]
        signs = np.stack([rows.torque >= 0.0, rows.torque < 0.0], axis=-1)
        self._turns.add(np.where(signs, turns[..., None], 0.0))
        self._heat.add(np.where(counted, rows.oil, 0.0) * times[0])
        warmest = np.where(counted, rows.oil, -math.inf).max(axis=0)
        self._highest = np.fmax(self._highest, np.where(warmest > 0.0, warmest, math.nan))
        self._counts += [which.sum(axis=0) for which in (counted, beyond, counted & ~rows.own_oil)]
        first = np.where(beyond, rows.time, math.inf).min(axis=0)
        unset = np.isnan(self._first_outside) & np.isfinite(first)
        self._first_outside[unset] = first[unset]

    def _load(self) -> None:
        """Take over the sums of the states."""
        states = self._states
        self._shafts.load(states)
        self._damage = stacked([state.damage for state in states])
        self._turns = stacked([state.turns for state in states])
        self._times = stacked([stacked([*vars(state.times).values()]) for state in states])
        self._heat = stacked([state.oil.integral for state in states])
        self._highest = np.array([state.oil.highest for state in states])
        self._counts = np.array(
            [
                [getattr(state.readings, name) for state in states]
                for name in ("counted", "outside", "no_oil_temperature")
            ]
        )
        self._first_outside = np.array([state.readings.first_outside for state in states])

    def _store(self, n: int, state: DamageState) -> None:
        """Write the sums of a gearbox to its state."""
        before = whole_passages(self._per_turn, state.turns.total)
        state.damage, state.turns = self._damage.of(n), self._turns.of(n)
        more = whole_passages(self._per_turn, state.turns.total) - before
        state.passages = [a + int(b) for a, b in zip(state.passages, more, strict=True)]
        self._shafts.store(n, state)
        times = self._times.of(n)
        state.times = Times(*(times.of(k) for k in range(3)))
        state.oil = OilTemperature(self._heat.of(n), float(self._highest[n]))
        counted, outside, no_oil = (int(count) for count in self._counts[:, n])
        state.readings = Readings(counted, outside, float(self._first_outside[n]), no_oil)
