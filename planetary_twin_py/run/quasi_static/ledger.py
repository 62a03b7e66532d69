"""The energy ledger and the mesh sums of a quasi-static run, at any time.

In steady running whose powers repeat with the mesh cycle, one cycle is integrated and multiplied.
With a changing speed, a torque ripple, runout or faulty teeth, every panel is integrated.
"""

from __future__ import annotations

import math
from copy import copy

import numpy as np

from ..._core import (
    COAST_SIDE,
    DRIVE_SIDE,
    DTE,
    HEAT,
    LEDGER,
    MESH_FORCE,
    SUMS,
    MeshSums,
    Model,
    Passages,
    State,
)
from ...model.clock import Instant, delay
from ...model.layout import MOTOR
from .passage_ledger import AtPoint, PassageLedger

# Entries of the totals, in this order: the ledger, integrals of the meshes (SUMS, room),
# and the time.
ENERGY, MEAN = slice(0, LEDGER), slice(LEDGER, None)
ON_EDGE = 1e-11  # mesh cycles; a panel that is closer to its end has ended
SAME = 1e-12  # mesh cycles; closer edges are merged


class Ledger:
    """Integrals of the powers since the start, at one operating point.

    Args:
        train: at this operating point.
        origin: position of the motors.
        energy: ledger so far (LEDGER,).
        passages: peaks of the tooth pairs in mesh, which are followed.

    Raises:
        ValueError: see `solve_equilibrium` and `divide_cycle`.
    """

    def __init__(
        self, train: AtPoint, origin: State, energy: np.ndarray, passages: Passages
    ) -> None:
        self._core, self._model, self._tolerance, self._closing_side = train
        self._reached = origin.copy()
        self._popped = Instant(origin.seconds, origin.time)
        self._totals = np.zeros(self._core.TOTALS)
        self._peak = np.zeros((self._core.PEAKS, self._core.MESHES))
        self._totals[ENERGY] = energy
        self._run = self._core.first_guess(self._closing_side)
        self._repeated_both_flanks = 0
        self._repeats = _repeats(self._model)
        self._edges = self._corners(origin)
        self._cycle: tuple[np.ndarray, np.ndarray, np.ndarray] | None = None
        self._cycle_both_flanks = 0
        self._edges = self._panels(origin)
        self._damage = PassageLedger(train, origin, passages)

    @property
    def both_flanks(self) -> int:
        """Equilibria so far in which both flanks of a mesh touch."""
        return int(self._run.both_flanks) + self._repeated_both_flanks

    def beside(self) -> Ledger:
        """A ledger from here on of its own, which does not depend on when this one is read."""
        other = copy(self)
        other._reached = self._reached.copy()
        other._totals, other._peak = np.zeros_like(self._totals), np.zeros_like(self._peak)
        other._run = self._core.first_guess(self._closing_side)
        return other

    def pop_energy(self, time: Instant) -> np.ndarray:
        """Energy ledger from the previous call to `time`, which is not before the origin.

        Heat is that since the start.
        """
        energy = self.at(time)[0][ENERGY]
        self._totals[:HEAT] -= energy[:HEAT]
        return energy

    def pop_mesh_sums(self, time: Instant, sums: MeshSums) -> None:
        """Fill `sums` with integrals and extremes of the meshes from the previous call to `time`.

        Extremes are those of all panels that overlap this interval.
        """
        totals, peak = self.at(time)
        self._totals[MEAN] -= totals[MEAN]
        self._peak[:], self._popped = 0.0, time
        integrals = totals[MEAN]
        sums.time, sums.integral = integrals[-1], integrals[:-1].reshape(SUMS, -1)
        sums.dte_peak, sums.force_peak = peak[:2]
        if self._model.train.durability.active:
            repeats = self._repeats and self._is_steady()
            self._damage.follow(time, self._edges, sums, repeats)

    def at(self, time: Instant) -> tuple[np.ndarray, np.ndarray]:
        """Totals (TOTALS,) and peaks (PEAKS, MESHES) from the previous call to `time`."""
        self._core.integrate_panels(
            self._model, self._tolerance, self._reached, self._run, self._edges, time,
            self._repeats, self._totals, self._peak,
        )  # fmt: skip
        left = delay(self._reached, time)
        if not self._repeats or not self._is_steady():
            return self._with(*self._integral(0.0, left))
        rate = abs(self._core.frame_cycle_rate(self._model.train, self._reached))
        if rate == 0.0:
            rates, peak = self._rates(time)
            self._move(rates * left, peak, left)
            return self._totals.copy(), self._peak.copy()
        return self._cycles(time, 1.0 / rate)

    def _with(self, gain: np.ndarray, peak: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Totals and peaks, increased by `gain` and `peak`."""
        return self._totals + gain, np.maximum(self._peak, peak)

    def _cycles(self, time: Instant, period: float) -> tuple[np.ndarray, np.ndarray]:
        """Totals and peaks, after moving by whole mesh cycles and adding the remainder."""
        if self._cycle is None:
            self._cycle, self._cycle_both_flanks = self._divide(self._model, self._reached)
        phase, totals, _ = self._cycle
        whole = math.floor(delay(self._reached, time) / period + ON_EDGE)
        if whole > 0:
            self._repeated_both_flanks += whole * self._cycle_both_flanks
            self._move(whole * totals[-1], self._seen(1.0, period), whole * period)
        left = max(delay(self._reached, time), 0.0)
        last = int(np.searchsorted(phase, left / period + ON_EDGE, "right")) - 1
        last = min(last, len(phase) - 2)
        rest, peak = self._integral(period * phase[last], left)
        seen = self._seen(phase[last], period)
        return self._with(totals[last] + rest, np.maximum(seen, peak))

    def _seen(self, until: float, period: float) -> np.ndarray:
        """Peaks of the panels from the last reset to the fraction `until` of the mesh cycle."""
        assert self._cycle is not None
        phase, _, peaks = self._cycle
        since = max(delay(self._reached, self._popped), 0.0) / period
        within = (phase > since) & (phase <= until)
        return peaks[within].max(axis=0, initial=0.0)

    def _move(self, gain: np.ndarray, peak: np.ndarray, time: float) -> None:
        """Move the end of the integrals by `time` [s] and add `gain` and `peak` to the totals."""
        self._totals, self._peak = self._with(gain, peak)
        self._core.advance_shafts(self._model, self._reached, time, self._reached)

    def _panels(self, origin: State) -> np.ndarray:
        """Edges of panels [mesh cycles of the frame], fine enough for the target speed."""
        for speed in (self._model.operation.target_speed, origin.set_speed):
            model, state = self._model.copy(), origin.copy()
            model.operation.target_speed = speed
            state.set_speed = state.speed = speed
            rate = self._core.frame_cycle_rate(model.train, state)
            if rate != 0.0:
                cycle, both_flanks = self._divide(model, state)
                if self._repeats and self._is_steady():  # then this is the cycle that repeats
                    self._cycle, self._cycle_both_flanks = cycle, both_flanks
                phase = cycle[0]
                first = self._core.frame_cycle(model.train, state, 1)
                return np.mod(first + math.copysign(1.0, rate) * phase[:-1], 1.0)
        return self._edges

    def _divide(
        self, model: Model, origin: State
    ) -> tuple[tuple[np.ndarray, np.ndarray, np.ndarray], int]:
        """A mesh cycle in panels, and the number of its equilibria with both flanks in touch."""
        rate = self._core.frame_cycle_rate(model.train, origin)
        first = self._core.frame_cycle(model.train, origin, 1)
        ahead = np.mod(math.copysign(1.0, rate) * (self._edges - first), 1.0)
        edges = np.unique(np.concatenate([[0.0, 1.0], ahead]))
        edges = edges[np.append(np.diff(edges) > SAME, True)]
        edges[0], edges[-1] = 0.0, 1.0
        run = self._core.first_guess(self._closing_side)
        cycle = self._core.divide_cycle(model, self._tolerance, origin, run, edges, 1.0 / abs(rate))
        return cycle, int(run.both_flanks)

    def _corners(self, origin: State) -> np.ndarray:
        """Mesh cycles of the frame at which the ramp of a tooth pair begins or ends."""
        train, operation = self._model.train, self._model.operation
        run = self._core.first_guess(self._closing_side)
        self._core.advance_shafts(self._model, origin, 0.0, run.state)
        self._core.solve_equilibrium(self._model, self._tolerance, run)
        shift = self._core.cycle_shift(train, run.state.x)
        reverses = operation.ripple >= abs(operation.torque[MOTOR])
        sides = (DRIVE_SIDE, COAST_SIDE) if reverses else (self._closing_side,)
        corners = []
        for i in range(train.meshes):
            kind = train.mesh.kind[i]
            edge = train.teeth.edge[kind, : train.teeth.segments[kind]]
            for side in sides:
                if side not in self._sides_of(i):
                    continue
                late = float(train.geometry.coast_lead[kind]) if side == COAST_SIDE else 0.0
                corners.append(side * (edge - late) + train.mesh.phase[i] - shift)
        return np.unique(np.mod(np.concatenate(corners), 1.0))

    def _sides_of(self, mesh: int) -> tuple[int, ...]:
        """Sides of the flanks that an entry of the meshes stands for."""
        train = self._model.train
        if int(train.moving.bearings) == 0:
            return (DRIVE_SIDE, COAST_SIDE)
        return (DRIVE_SIDE,) if mesh < train.meshes // 2 else (COAST_SIDE,)

    def _is_steady(self) -> bool:
        return bool(np.all(self._reached.set_speed == self._model.operation.target_speed))

    def _integral(self, begin: float, end: float) -> tuple[np.ndarray, np.ndarray]:
        """Totals and peaks between two times after the end of the integrals [s] in one panel.

        It starts from a new guess and changes no state.
        """
        run = self._core.first_guess(self._closing_side)
        return self._core.integrate(self._model, self._tolerance, self._reached, run, (begin, end))

    def power(self, time: Instant) -> np.ndarray:
        """Time derivative of the ledger [W] at `time`, not before the end of the integrals."""
        return self._rates(time)[0][ENERGY]

    def _rates(self, time: Instant) -> tuple[np.ndarray, np.ndarray]:
        """Time derivative of the totals at `time`, and the peaks at that instant."""
        run, rates = self._core.first_guess(self._closing_side), np.zeros(self._core.TOTALS)
        peak = np.zeros((self._core.PEAKS, self._core.MESHES))
        self._core.advance_shafts(self._model, self._reached, delay(self._reached, time), run.state)
        shown = self._core.solve_equilibrium(self._model, self._tolerance, run)
        train = self._model.train
        self._core.add_rates(train, run.evaluation.power, shown, 1.0, rates)
        peak[:2, : train.meshes] = np.abs(shown[[DTE, MESH_FORCE]])
        return rates, peak


def _repeats(model: Model) -> bool:
    """Whether the powers of steady running depend only on the position in the mesh cycle."""
    train = model.train
    periods = [train.errors.period[kind, : train.errors.lines[kind]] for kind in range(2)]
    at_rest = model.operation.ripple == 0.0 and train.moving.gravity == 0.0
    return bool(at_rest and train.faults.count == 0 and np.all(np.concatenate(periods) == 1))
