"""Follows teeth that have changed: sizes, kinds and times of their changes, and their events."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...text.intervals import plus_minus
from ..estimate import CONFIDENT, Estimate, Event, estimated, not_identifiable
from .baseline import Baseline
from .compliance import Compliance
from .kind import ToothKind
from .onset import onset_of
from .scores import Bank
from .search import Found
from .shape_error import shape_error

Array = NDArray[np.float64]

UNSCALED = 0.35  # relative standard deviation of a size without a compliance, or at a load that was
# learned with a changed tooth


class ToothState(NamedTuple):
    """A tooth that has changed."""

    gear: str
    """"sun", "planet_1", ..., "ring"."""
    tooth: int
    """Number of the tooth; tooth 0 meets planet 1 first after the encoders start."""
    loss: Estimate
    """Loss of stiffness of a pair with this tooth, if the change is a crack; its status is LEARNING
    until a whole hunting period follows the change."""
    z: float
    """Amount of its signature in standard deviations."""
    kinds: tuple[str, ...]
    """Possible kinds of change; one if a change of load has distinguished them."""
    candidates: tuple[str, ...]
    """Teeth that explain the readings equally well, this one first."""

    @property
    def as_likely(self) -> str:
        """End of a line that names the other candidates; "" if there are none."""
        others = ", ".join(self.candidates[1:])
        return f"; as likely: {others}" if others else ""


class JudgedBlock(NamedTuple):
    """Residual of a hunting period, which is one block."""

    residual: Array
    """Deviation from the baseline [m], (cycles, BINS)."""
    measured: NDArray[np.bool_]
    """Where it is measured, (cycles, BINS)."""
    products: Array
    """Scalar products with the signature of each tooth [m^2], (teeth,)."""
    squares: Array
    """Those of the signatures with themselves [m^2], (teeth,)."""
    torque: float
    """Mean input torque [N m]."""
    begin: float
    """Its begin [s]."""
    end: float
    """Its end [s]."""


@dataclass
class ChangedTeeth:
    """Teeth that have changed since the baselines were learned; new ones become `events`."""

    learning: int
    compliance: Compliance
    events: list[Event]
    states: tuple[ToothState, ...] = field(init=False, default=())
    """State of each tooth that has changed."""

    def __post_init__(self) -> None:
        self._kinds: dict[int, ToothKind] = {}
        self._amounts: dict[int, float] = {}
        self._event_index: dict[int, int] = {}  # in `events`, by tooth
        self._changed_by: dict[int, float] = {}  # time before which a tooth has changed [s]

    def clear(self) -> None:
        """Report no changed tooth; kinds and events remain."""
        self.states, self._amounts = (), {}

    def update(
        self, matches: list[Found], cell: Baseline, recent: Sequence[JudgedBlock], noise: float
    ) -> None:
        """Report the teeth of a search as changed; a new tooth is an event.

        `recent` are the blocks in the cell, the last one being the present; `noise` is the standard
        deviation in the window of the search over that of one block.
        """
        bank = cell.bank
        assert bank is not None  # set with the cell
        states = []
        previous, self._amounts = dict(self._amounts), {}
        teeth = [candidate.tooth for candidate in matches]
        amounts = _amounts_of(teeth, bank, recent)
        for column, match in enumerate(matches):
            tooth_amounts = amounts[:, column]
            tooth_index = next((t for t in previous if t in match.candidates), match.tooth)
            tooth = bank.teeth[tooth_index]
            sd = match.sd / noise
            since, after = self._onset(tooth_index, tooth_amounts, sd, recent)
            self._amounts[tooth_index] = (
                float(np.mean(tooth_amounts[after])) if after.any() else match.amount
            )
            torques = np.array([judged.torque for judged in recent])[after]
            kind = self._kinds.setdefault(tooth_index, ToothKind(self.learning))
            others = (other for other in match.candidates if other != tooth_index)
            shape = _shape_error(cell, teeth, column, amounts, recent, after)
            state = ToothState(
                tooth.gear,
                tooth.number,
                self._estimate_loss(cell, tooth_amounts[after], torques, (sd, shape)),
                match.z,
                kind.kinds,
                tuple(str(bank.teeth[candidate]) for candidate in (tooth_index, *others)),
            )
            states.append(state)
            self._record_event(tooth_index, state, (since, recent[-1].end))
        self.states = tuple(states)

    def _onset(
        self, tooth: int, amounts: Array, sd: float, recent: Sequence[JudgedBlock]
    ) -> tuple[float, NDArray[np.bool_]]:
        """Earliest start of a change [s], and which recent blocks surely follow it."""
        begins = np.array([judged.begin for judged in recent])
        known = self._changed_by.get(tooth, math.inf)
        if begins[0] >= known:
            return known, np.ones(len(begins), dtype=bool)
        onset = onset_of(amounts, sd)
        first, last = recent[onset.first], recent[onset.last]
        self._changed_by[tooth] = last.end
        # A step later than half of a block belongs to the next one.
        return first.begin - 0.5 * (first.end - first.begin), begins >= last.end

    def _estimate_loss(
        self, cell: Baseline, amounts: Array, torques: Array, uncertain: tuple[float, float]
    ) -> Estimate:
        """Loss of stiffness from the amounts and torques of the blocks after a change.

        `uncertain` has the standard deviation of one amount, and the relative one of its shape.
        """
        if not len(amounts):
            remedy = "the next hunting period"
            return not_identifiable("stiffness_loss", math.nan, "", remedy, "LEARNING")
        assert cell.bank is not None  # set with the cell
        sd, relative_sd = uncertain
        bank, regression = cell.bank, self.compliance.present
        scale = float(np.mean(torques)) / bank.torque
        if regression is not None and regression.significant:
            scale *= regression.slope / bank.compliance
        scaled = regression is not None and regression.significant and not cell.taken_off
        if not (scaled and math.isfinite(relative_sd)):
            relative_sd = np.fmax(relative_sd, UNSCALED)
        loss = float(np.mean(amounts)) / scale
        total_sd = math.hypot(sd * cell.noise(torques) / scale, relative_sd * loss)
        return estimated("stiffness_loss", loss, total_sd, "")

    def _record_event(self, tooth: int, state: ToothState, times: tuple[float, float]) -> None:
        """Add an event, with its earliest start and its detection [s], or update it."""
        size = state.loss
        size_text = (
            f"loss {plus_minus(100.0 * size.value, 100.0 * CONFIDENT * size.sd)} %"
            if size.status == "ESTIMATED"
            else f"its size follows from {size.remedy}"
        )
        evidence = f"z = {state.z:.1f}, {size_text}{state.as_likely}"
        description = f"{state.gear} tooth {state.tooth} changed"
        if tooth not in self._event_index:
            self._event_index[tooth] = len(self.events)
            self.events.append(Event(description, *times, size, state.kinds, evidence))
            return
        event_index = self._event_index[tooth]
        self.events[event_index] = replace(
            self.events[event_index], size=size, causes=state.kinds, evidence=evidence
        )

    @property
    def any(self) -> bool:
        """Whether any tooth has changed."""
        return bool(self._amounts)

    def add(
        self,
        residual: Array,
        measured: NDArray[np.bool_],
        at: tuple[Baseline, int],
        torque: float,
    ) -> None:
        """Add the amount of every changed tooth in one block, with the others subtracted.

        Residual [m] and mask are (cycles, BINS), `at` is the baseline and the index of its cell.
        """
        cell, cell_index = at
        assert cell.bank is not None  # set with the cell
        cycles = len(residual)
        for tooth in self._amounts:
            remainder = residual.copy()
            for other, amount in self._amounts.items():
                if other != tooth:
                    remainder -= amount * cell.bank.deviation(other, cycles) * measured
            products, squares = cell.bank.score(remainder, measured)
            sd = float(cell.sd[cell.bank.gear_of[tooth]])
            kind = self._kinds[tooth]
            kind.add(cell_index, torque, float(products[tooth] / squares[tooth]), sd)
        self.states = tuple(self._with_kinds(state, cell.bank) for state in self.states)

    def _with_kinds(self, state: ToothState, bank: Bank) -> ToothState:
        """A state and its event, with the kinds that are possible now."""
        tooth = bank.teeth.index((state.gear, state.tooth))  # type: ignore[arg-type]
        kinds = self._kinds[tooth].kinds
        if kinds != state.kinds and tooth in self._event_index:
            event_index = self._event_index[tooth]
            self.events[event_index] = replace(self.events[event_index], causes=kinds)
        return state._replace(kinds=kinds)

    def subtract_from(self, cell: Baseline, cell_index: int) -> None:
        """Subtract the changed teeth from a baseline that was learned with them."""
        assert cell.bank is not None and cell.mean is not None  # it has been learned
        for tooth, kind in self._kinds.items():
            if tooth in self._amounts:
                cell.taken_off = True
                cell.mean -= kind.amount(cell_index) * cell.bank.deviation(tooth, len(cell.mean))


def _amounts_of(teeth: list[int], bank: Bank, recent: Sequence[JudgedBlock]) -> Array:
    """Amounts of some teeth in every recent block by joint least squares, (blocks, teeth)."""
    amounts = []
    for judged in recent:
        rows = np.array([bank.deviation(tooth, len(judged.residual)).ravel() for tooth in teeth])
        gram = (rows * judged.measured.ravel()) @ rows.T
        inverse = np.linalg.pinv(gram, hermitian=True)  # two may have the same best tooth
        amounts.append(inverse @ (rows @ judged.residual.ravel()))
    return np.array(amounts)


def _shape_error(
    cell: Baseline, teeth: list[int], column: int, amounts: Array, recent: Sequence[JudgedBlock],
    after: NDArray[np.bool_],
) -> float:  # fmt: skip
    """`shape_error` of one of some teeth, from the blocks after its change; NaN without any."""
    if not after.any():
        return math.nan
    bank, residuals = cell.bank, np.array([judged.residual for judged in recent])
    assert bank is not None  # set with the cell
    later, cycles = residuals[after], residuals.shape[1]
    for other, amount in zip(teeth, amounts[after].mean(axis=0), strict=True):
        if other != teeth[column]:
            later = later - amount * bank.deviation(other, cycles)
    tooth = bank.teeth[teeth[column]]
    signature = np.roll(bank.gears[tooth.gear], tooth.number, axis=0)
    return shape_error(signature, later, residuals[~after], cell.needed)
