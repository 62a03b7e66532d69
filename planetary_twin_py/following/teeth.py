"""Estimates changes of teeth from two encoders: cracks, wear, compliance and backlash."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..interval_text import plus_minus
from ..scene import Scene, SceneError
from .baseline import Baseline, LearnedCell
from .baseline_file import TeethBaseline
from .checks import InputError
from .compliance import Compliance
from .encoder_check import EncoderCheck
from .estimate import CONFIDENT, Estimate, Event, estimated, not_identifiable
from .hunting_blocks import EncoderCounters, HuntingBlock, HuntingBlocks
from .onset import onset_of
from .signatures import signatures
from .tooth_kind import ToothKind
from .tooth_scores import Bank
from .tooth_search import ALARM, Found, Residual, find_teeth
from .train import followed_train
from .transmission_error import Counts

Array = NDArray[np.float64]

MISPLACED = (
    "teeth: the loaded baseline belongs to another position of the encoders and is not used; a "
    "baseline is learned"
)
WINDOWS = 1, 4, 16, 64  # numbers of blocks that are judged together
UNCERTAIN = 0.15  # relative standard deviation of a size: runout shifts load between teeth
UNSCALED = 0.35  # the same without a compliance, or at a load learned with a changed tooth
WAITING = 64  # largest number of hunting periods that wait for readings of the torque
SPEED_STEP = 0.3  # relative difference of the speeds for which signatures are computed


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


class _Judged(NamedTuple):
    """Residual of a block."""

    residual: Array
    measured: NDArray[np.bool_]
    products: Array
    squares: Array
    torque: float
    begin: float  # [s]
    end: float  # [s]


@dataclass
class TeethFollower:
    """Learns a baseline for each operating cell, and finds teeth that change.

    Args:
        scene: scene of the gearbox, with one input.
        counts_per_turn: counts per turn of the encoders on the input and the output member.
        period: sample period [s].
        learning: number of hunting periods of a baseline.
    """

    scene: Scene
    counts_per_turn: tuple[int, int]
    period: float
    learning: int = 24
    events: list[Event] = field(init=False, default_factory=list)
    """Detected changes."""
    teeth: tuple[ToothState, ...] = field(init=False, default=())
    """Teeth that have changed."""
    blocks: int = field(init=False, default=0)
    """Number of hunting periods that have been judged."""
    compared: int = field(init=False, default=0)
    """Number of hunting periods that have been compared with a baseline."""
    every_z: tuple[float, ...] = field(init=False, default=())
    """Amount of the signature of every tooth in the last hunting period, in standard deviations;
    empty while a baseline is being learned."""
    outstanding: float = field(init=False, default=-math.inf)
    """The largest such amount of any tooth in any window that ends with that period."""

    def __post_init__(self) -> None:
        first, second = self.counts_per_turn
        if min(first, second) < 1 or not self.period > 0.0:
            raise SceneError(
                f"counts_per_turn = {first}, {second}, period = {self.period!r} s: must be above 0"
            )
        self.train = followed_train(self.scene)
        self._check = EncoderCheck(self.train, self.counts_per_turn)
        self._hunting = HuntingBlocks(self.train, self.counts_per_turn, self.period)
        self._pending: deque[HuntingBlock] = deque()
        self._banks: dict[tuple[float, float], Bank] = {}  # by torque and speed
        self._torque_assumed = False
        self.learn()

    def learn(self) -> None:
        """Forget baselines and changed teeth; events remain. The next blocks are learned."""
        self._cells: list[Baseline] = []
        self._restore_remark: str | None = None  # if the baseline does not fit
        self._unverified = False  # restored and not yet compared with a block
        self.teeth, self.every_z, self.outstanding = (), (), -math.inf
        self._recent: deque[_Judged] = deque(maxlen=WINDOWS[-1])
        self._cell: int | None = None
        self._kinds: dict[int, ToothKind] = {}
        self._amounts: dict[int, float] = {}
        self._event_index: dict[int, int] = {}  # in `events`, by tooth
        self._changed_by: dict[int, float] = {}  # time before which a tooth has changed [s]
        self.compliance = Compliance(self.learning)
        self._estimates: tuple[Estimate, ...] | None = None  # since the last hunting period

    @property
    def saved(self) -> TeethBaseline | None:
        """Learned baselines with valid positions; None if there are none."""
        segment = self.counters.segments
        cells = [cell for cell in self._cells if cell.learned and cell.segment == segment]
        if not cells:
            return None
        fields = tuple(cell.fields() for cell in cells)
        return TeethBaseline(self.counts_per_turn, self.period, fields, self.compliance.first)

    def restore(self, saved: TeethBaseline) -> None:
        """Use saved baselines instead of learning.

        Args:
            saved: baselines of the same encoders, whose counts have continued since.

        Raises:
            InputError: they are of other encoders.
        """
        expected = self.counts_per_turn, self.period
        if (saved.counts_per_turn, saved.period) != expected:
            raise InputError(
                f"baseline: counts per turn {saved.counts_per_turn} and period {saved.period:g} s: "
                f"must be {expected[0]} and {expected[1]:g} s as of the encoders"
            )
        self.learn()
        segment = self.counters.segments
        self._cells = [Baseline.of_fields(fields, segment) for fields in saved.cells]
        self.compliance = Compliance(
            self.learning, segment, [tuple(block) for block in saved.blocks]
        )
        self._unverified = True

    @property
    def counters(self) -> EncoderCounters:
        """Numbers of samples that were not used, by reason."""
        return self._hunting.counters

    @property
    def cells(self) -> tuple[LearnedCell, ...]:
        """Learning state of each operating cell."""
        return tuple(cell.summary for cell in self._cells)

    def add(self, sample: Counts, counts: Counts) -> None:
        """Add samples in the order of their arrival.

        Args:
            sample: numbers of the samples, (n,): times in sample periods.
            counts: counts of both encoders, (n, 2).

        Raises:
            InputError: the encoders do not turn in the ratio of the teeth.
        """
        self._check.add(counts)
        while len(self._pending) > WAITING:  # readings have ended
            self._pending.popleft()
            self.counters.dropped_blocks += 1
        self._pending.extend(self._hunting.add(sample, counts))

    def finish(self) -> None:
        """Process the samples that are held back, at the end of a recording."""
        self._pending.extend(self._hunting.finish())

    def judge(self, until: float, torque: Callable[[float, float], float]) -> None:
        """Judge the hunting periods that end by a time.

        Args:
            until: time up to which the torque is known [s].
            torque: function of two times [s] that returns the mean input torque between them
                [N m]; NaN if it was not measured: then the torque of the scene is used.
        """
        while self._pending and self._pending[0].end <= until:
            block = self._pending.popleft()
            self._judge(block, torque(block.begin, block.end))

    def _judge(self, block: HuntingBlock, torque: float) -> None:
        if self._cells and block.segment > self._cells[-1].segment:
            self.learn()  # teeth are numbered from the new start
        self.blocks += 1
        speed = 2.0 * math.pi * block.rate / abs(float(self.train.cycles))
        self._estimates = None
        self.compliance.add(block.segment, torque, speed, block.mean)
        if not math.isfinite(torque):
            torque, self._torque_assumed = self.scene.operating_point.input_torque, True
        cell_index = self._find_cell(block, torque, speed)
        cell = self._cells[cell_index]
        if cell_index != self._cell:
            self._cell = cell_index
            self._recent.clear()
        if not cell.learned:
            self.every_z = ()
            self._follow_known_teeth(block, torque, cell_index)
            cell.learn(block, torque)
            if cell.learned:
                self._subtract_known_teeth(cell, cell_index)
            return
        assert cell.bank is not None  # set with the cell
        self.compared += 1
        residual, measured = cell.residual(block, torque)
        products, squares = cell.bank.score(residual, measured)
        self._recent.append(
            _Judged(residual, measured, products, squares, torque, block.begin, block.end)
        )
        self._add_known_amounts(residual, measured, (cell, cell_index), torque)
        self._search_windows(block, cell)

    def _find_cell(self, block: HuntingBlock, torque: float, speed: float) -> int:
        """Index of the operating cell of a block; a new one if there is none."""
        for cell_index, cell in enumerate(self._cells):
            if cell.covers(torque, speed, block.segment):
                if cell.bank is None:  # restored
                    cell.bank = self._bank(torque, speed)
                if self._unverified and cell.learned and cell.moved(block):
                    self.learn()
                    self._restore_remark = MISPLACED
                    break
                self._unverified = False
                return cell_index
        bank = self._bank(torque, speed)
        self._cells.append(Baseline(torque, speed, block.segment, self.learning, bank))
        return len(self._cells) - 1

    def _bank(self, torque: float, speed: float) -> Bank:
        """Signatures at a similar speed; they scale with the torque, whose sign selects flanks."""
        train, point = self.train, self.scene.operating_point
        speed_step = round(math.log(speed / train.speed) / math.log1p(SPEED_STEP))
        similar_speed = min(train.speed * (1.0 + SPEED_STEP) ** speed_step, train.speed_limit)
        key = (
            math.copysign(train.torque, torque),
            math.copysign(similar_speed, point.input_speed or 1.0),
        )
        if key not in self._banks:
            self._banks[key] = Bank(signatures(self.scene, *key))
        return self._banks[key]

    def _search_windows(self, block: HuntingBlock, cell: Baseline) -> None:
        """Search for changed teeth in any window."""
        assert cell.bank is not None  # set with the cell
        block_sd = cell.sd[cell.bank.gear_of]
        products = np.array([judged.products for judged in self._recent])[::-1].cumsum(axis=0)
        squares = np.array([judged.squares for judged in self._recent])[::-1].cumsum(axis=0)
        torques = np.array([judged.torque for judged in self._recent])
        best, window = -math.inf, 1
        for length in WINDOWS:
            if length > len(self._recent):
                break
            sd = block_sd * cell.noise(torques[-length:])
            tooth_z = products[length - 1] / squares[length - 1] / sd
            if length == 1:
                self.every_z = tuple(tooth_z.tolist())
            z = float(np.max(tooth_z))
            if z > best:
                best, window = z, length
        self.outstanding = best
        if best < ALARM:
            self._clear_teeth()
            return
        recent = list(self._recent)[-window:]
        residual_sum = np.sum([judged.residual for judged in recent], axis=0)
        block_counts = np.sum([judged.measured for judged in recent], axis=0, dtype=float)
        sd = block_sd * cell.noise(torques[-window:])
        matches = find_teeth(cell.bank, Residual(residual_sum, block_counts, sd))
        if matches:
            self._update_teeth(matches, cell, block, cell.noise(torques[-window:]))
        else:
            self._clear_teeth()

    def _update_teeth(
        self, matches: list[Found], cell: Baseline, block: HuntingBlock, noise: float
    ) -> None:
        """Report the teeth of a search as changed; a new tooth is an event.

        `noise` is the standard deviation in the window of the search over that of one block.
        """
        bank = cell.bank
        assert bank is not None  # set with the cell
        states = []
        previous, self._amounts = dict(self._amounts), {}
        amounts = self._amounts_of([candidate.tooth for candidate in matches], bank)
        for match, tooth_amounts in zip(matches, amounts.T, strict=True):
            tooth_index = next((t for t in previous if t in match.candidates), match.tooth)
            tooth = bank.teeth[tooth_index]
            since, after = self._onset(tooth_index, tooth_amounts, match.sd / noise)
            self._amounts[tooth_index] = (
                float(np.mean(tooth_amounts[after])) if after.any() else match.amount
            )
            kind = self._kinds.setdefault(tooth_index, ToothKind(self.learning))
            state = ToothState(
                tooth.gear,
                tooth.number,
                self._estimate_loss(cell, tooth_amounts, after, match.sd / noise),
                match.z,
                kind.kinds,
                _tooth_names(
                    bank,
                    (tooth_index, *(other for other in match.candidates if other != tooth_index)),
                ),
            )
            states.append(state)
            self._record_event(tooth_index, state, (since, block.end))
        self.teeth = tuple(states)

    def _amounts_of(self, teeth: list[int], bank: Bank) -> Array:
        """Amounts of some teeth in every recent block by joint least squares, (blocks, teeth)."""
        amounts = []
        for judged in self._recent:
            rows = np.array(
                [bank.deviation(tooth, len(judged.residual)).ravel() for tooth in teeth]
            )
            gram = (rows * judged.measured.ravel()) @ rows.T
            inverse = np.linalg.pinv(gram, hermitian=True)  # two may have the same best tooth
            amounts.append(inverse @ (rows @ judged.residual.ravel()))
        return np.array(amounts)

    def _onset(self, tooth: int, amounts: Array, sd: float) -> tuple[float, NDArray[np.bool_]]:
        """Earliest start of a change [s], and which recent blocks surely follow it."""
        begins = np.array([judged.begin for judged in self._recent])
        known = self._changed_by.get(tooth, math.inf)
        if begins[0] >= known:
            return known, np.ones(len(begins), dtype=bool)
        onset = onset_of(amounts, sd)
        first, last = self._recent[onset.first], self._recent[onset.last]
        self._changed_by[tooth] = last.end
        # A step later than half of a block belongs to the next one.
        return first.begin - 0.5 * (first.end - first.begin), begins >= last.end

    def _estimate_loss(
        self, cell: Baseline, amounts: Array, after: NDArray[np.bool_], sd: float
    ) -> Estimate:
        """Loss of stiffness from the blocks after a change."""
        if not after.any():
            remedy = "the next hunting period"
            return not_identifiable("stiffness_loss", math.nan, "", remedy, "LEARNING")
        assert cell.bank is not None  # set with the cell
        torques = np.array([judged.torque for judged in self._recent])[after]
        scale, relative_sd = self._signature_scale(cell.bank, float(np.mean(torques)))
        if cell.taken_off:
            relative_sd = UNSCALED
        loss = float(np.mean(amounts[after])) / scale
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

    def _clear_teeth(self) -> None:
        """Report no changed tooth; teeth found before remain until the window is full."""
        if len(self._recent) >= WINDOWS[2]:
            self.teeth, self._amounts = (), {}

    def _signature_scale(self, bank: Bank, torque: float) -> tuple[float, float]:
        """Factor on the signatures of the bank, and the uncertainty of a size."""
        regression = self.compliance.present
        torque_ratio = torque / bank.torque
        if regression is None or not regression.significant:
            return torque_ratio, UNSCALED
        return torque_ratio * regression.slope / bank.compliance, UNCERTAIN

    def _follow_known_teeth(self, block: HuntingBlock, torque: float, cell_index: int) -> None:
        """Amounts of known teeth at a load that is being learned, from the nearest baseline."""
        candidates = [
            cell
            for cell in self._cells
            if cell.learned and cell.segment == block.segment and cell.torque * torque > 0.0
        ]
        if not candidates or not self._amounts:
            return
        cell = min(candidates, key=lambda candidate: abs(candidate.torque - torque))
        residual, measured = cell.residual(block, torque)
        self._add_known_amounts(residual, measured, (cell, cell_index), torque)

    def _add_known_amounts(
        self,
        residual: Array,
        measured: NDArray[np.bool_],
        at: tuple[Baseline, int],
        torque: float,
    ) -> None:
        """Amount of every known tooth in one block, with the others subtracted."""
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
        self.teeth = tuple(self._with_kinds(state, cell.bank) for state in self.teeth)

    def _with_kinds(self, state: ToothState, bank: Bank) -> ToothState:
        """A state and its event, with the kinds that are possible now."""
        tooth = bank.teeth.index((state.gear, state.tooth))  # type: ignore[arg-type]
        kinds = self._kinds[tooth].kinds
        if kinds != state.kinds and tooth in self._event_index:
            event_index = self._event_index[tooth]
            self.events[event_index] = replace(self.events[event_index], causes=kinds)
        return state._replace(kinds=kinds)

    def _subtract_known_teeth(self, cell: Baseline, cell_index: int) -> None:
        """Subtract a changed tooth from a baseline that was learned with it."""
        assert cell.bank is not None and cell.mean is not None  # it has been learned
        for tooth, kind in self._kinds.items():
            if tooth in self._amounts:
                cell.taken_off = True
                cell.mean -= kind.amount(cell_index) * cell.bank.deviation(tooth, len(cell.mean))

    def remarks(self) -> Iterator[str]:
        """Reasons why the estimates are less certain, one line each."""
        if self._restore_remark:
            yield self._restore_remark
        if self._torque_assumed:
            yield "encoders: the torque is not measured: that of the scene is assumed"
        if not self.blocks:
            yield "teeth: not judged, as the encoders show no complete hunting period"
        elif not self.compared and any(cell.learned for cell in self._cells):
            yield "teeth: not judged, as no hunting period follows those of the baseline"
        if self._cells and not any(cell.learned for cell in self._cells):
            most = max(cell.count for cell in self._cells)
            yield f"teeth: {most} of {self.learning} hunting periods of a baseline are learned"
        if self.counters.dropped_blocks:
            dropped = self.counters.dropped_blocks
            yield (
                f"encoders: {dropped} hunting periods with gaps, reversals or without readings are "
                "not used"
            )

    def estimates(self) -> tuple[Estimate, ...]:
        """Compliance, and changes of compliance and backlash since the baseline."""
        if self._estimates is None:
            per_input = 1.0 / (self.train.lever * abs(float(self.train.twist[0])))
            self._estimates = self.compliance.estimates(per_input)
        return self._estimates


def _tooth_names(bank: Bank, teeth: tuple[int, ...]) -> tuple[str, ...]:
    return tuple(str(bank.teeth[tooth]) for tooth in teeth)
