"""Estimates changes of teeth from two encoders: cracks, wear, compliance and backlash."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..scene import Scene, SceneError
from .baseline import Baseline, LearnedCell
from .baseline_file import TeethBaseline
from .checks import InputError
from .compliance import Compliance
from .encoder_check import EncoderCheck
from .estimate import CONFIDENT, Estimate, Event, Status, estimated, not_identifiable
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
UNSCALED = 0.35  # likewise without a compliance, or at a load learned with a changed tooth
WAITING = 64  # hunting periods that wait for readings of the torque at most
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
    """Teeth that explain the readings equally well, including this one."""


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
        self._unmeasured = False
        self.learn()

    def learn(self) -> None:
        """Forget baselines and changed teeth; events remain. The next blocks are learned."""
        self._cells: list[Baseline] = []
        self._restored: str | None = None  # remark if the baseline does not fit
        self._unproven = False  # a restored baseline has not been compared with a block
        self.teeth, self.every_z, self.outstanding = (), (), -math.inf
        self._recent: deque[_Judged] = deque(maxlen=WINDOWS[-1])
        self._cell: int | None = None
        self._kinds: dict[int, ToothKind] = {}
        self._amounts: dict[int, float] = {}
        self._place: dict[int, int] = {}  # of the event of a tooth
        self._changed_by: dict[int, float] = {}  # time before which a tooth has changed [s]
        self.compliance = Compliance(self.learning)
        self._estimates: tuple[Estimate, ...] | None = None  # since the last hunting period

    @property
    def saved(self) -> TeethBaseline | None:
        """Learned baselines with valid positions; None if there are none."""
        segment = self.counters.segments
        cells = [one for one in self._cells if one.learned and one.segment == segment]
        if not cells:
            return None
        fields = tuple(one.fields() for one in cells)
        return TeethBaseline(self.counts_per_turn, self.period, fields, self.compliance.first)

    def restore(self, saved: TeethBaseline) -> None:
        """Use saved baselines instead of learning.

        Args:
            saved: baselines of the same encoders, whose counts have continued since.

        Raises:
            InputError: they are of other encoders.
        """
        own = self.counts_per_turn, self.period
        if (saved.counts_per_turn, saved.period) != own:
            raise InputError(
                f"baseline: counts per turn {saved.counts_per_turn} and period {saved.period:g} s: "
                f"must be {own[0]} and {own[1]:g} s as of the encoders"
            )
        self.learn()
        segment = self.counters.segments
        self._cells = [Baseline.of_fields(one, segment) for one in saved.cells]
        self.compliance = Compliance(self.learning, segment, [tuple(b) for b in saved.blocks])
        self._unproven = True

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
            torque, self._unmeasured = self.scene.operating_point.input_torque, True
        place = self._cell_of(block, torque, speed)
        cell = self._cells[place]
        if place != self._cell:
            self._cell = place
            self._recent.clear()
        if not cell.learned:
            self.every_z = ()
            self._follow_known(block, torque, place)
            cell.learn(block, torque)
            if cell.learned:
                self._take_off_known(cell, place)
            return
        assert cell.bank is not None  # set with the cell
        residual, measured = cell.residual(block, torque)
        products, squares = cell.bank.score(residual, measured)
        self._recent.append(
            _Judged(residual, measured, products, squares, torque, block.begin, block.end)
        )
        self._note_amounts(residual, measured, (cell, place), torque)
        self._decide(block, cell)

    def _cell_of(self, block: HuntingBlock, torque: float, speed: float) -> int:
        """Index of the operating cell of a block; a new one if there is none."""
        for place, cell in enumerate(self._cells):
            if cell.covers(torque, speed, block.segment):
                if cell.bank is None:  # restored
                    cell.bank = self._bank(torque, speed)
                if self._unproven and cell.learned and cell.moved(block):
                    self.learn()
                    self._restored = MISPLACED
                    break
                self._unproven = False
                return place
        bank = self._bank(torque, speed)
        self._cells.append(Baseline(torque, speed, block.segment, self.learning, bank))
        return len(self._cells) - 1

    def _bank(self, torque: float, speed: float) -> Bank:
        """Signatures at a similar speed; they scale with the torque, whose sign selects flanks."""
        train, point = self.train, self.scene.operating_point
        step = round(math.log(speed / train.speed) / math.log1p(SPEED_STEP))
        near = min(train.speed * (1.0 + SPEED_STEP) ** step, train.speed_limit)
        key = math.copysign(train.torque, torque), math.copysign(near, point.input_speed or 1.0)
        if key not in self._banks:
            self._banks[key] = Bank(signatures(self.scene, *key))
        return self._banks[key]

    def _decide(self, block: HuntingBlock, cell: Baseline) -> None:
        """Search for changed teeth in any window."""
        assert cell.bank is not None  # set with the cell
        own = cell.sd[cell.bank.gear_of]
        products = np.array([one.products for one in self._recent])[::-1].cumsum(axis=0)
        squares = np.array([one.squares for one in self._recent])[::-1].cumsum(axis=0)
        torques = np.array([one.torque for one in self._recent])
        best, window = -math.inf, 1
        for count in WINDOWS:
            if count > len(self._recent):
                break
            sd = own * cell.noise(torques[-count:])
            every = products[count - 1] / squares[count - 1] / sd
            if count == 1:
                self.every_z = tuple(every.tolist())
            z = float(np.max(every))
            if z > best:
                best, window = z, count
        self.outstanding = best
        if best < ALARM:
            self._clear_teeth()
            return
        recent = list(self._recent)[-window:]
        total = np.sum([one.residual for one in recent], axis=0)
        blocks = np.sum([one.measured for one in recent], axis=0, dtype=float)
        sd = own * cell.noise(torques[-window:])
        found = find_teeth(cell.bank, Residual(total, blocks, sd))
        if found:
            self._name(found, cell, block, cell.noise(torques[-window:]))
        else:
            self._clear_teeth()

    def _name(self, found: list[Found], cell: Baseline, block: HuntingBlock, noise: float) -> None:
        """Use the teeth of a search as the state; a new tooth is an event.

        `noise` is the standard deviation in the window of the search over that of one block.
        """
        bank = cell.bank
        assert bank is not None  # set with the cell
        states = []
        before, self._amounts = dict(self._amounts), {}
        amounts = self._amounts_of([one.tooth for one in found], bank)
        for one, every in zip(found, amounts.T, strict=True):
            named = next((t for t in before if t in one.candidates), one.tooth)
            tooth = bank.teeth[named]
            since, after = self._onset(named, every, one.sd / noise)
            self._amounts[named] = float(np.mean(every[after])) if after.any() else one.amount
            kind = self._kinds.setdefault(named, ToothKind(self.learning))
            state = ToothState(
                tooth.gear,
                tooth.number,
                self._loss(cell, every, after, one.sd / noise),
                one.z,
                kind.kinds,
                _names(bank, (named, *(other for other in one.candidates if other != named))),
            )
            states.append(state)
            self._record_event(named, state, (since, block.end))
        self.teeth = tuple(states)

    def _amounts_of(self, teeth: list[int], bank: Bank) -> Array:
        """Amounts of some teeth in every recent block by joint least squares, (blocks, teeth)."""
        found = []
        for one in self._recent:
            rows = np.array([bank.deviation(t, len(one.residual)).ravel() for t in teeth])
            square = (rows * one.measured.ravel()) @ rows.T
            inverse = np.linalg.pinv(square, hermitian=True)  # two may have the same best tooth
            found.append(inverse @ (rows @ one.residual.ravel()))
        return np.array(found)

    def _onset(self, tooth: int, amounts: Array, sd: float) -> tuple[float, NDArray[np.bool_]]:
        """Earliest start of a change [s], and which recent blocks surely follow it."""
        begins = np.array([one.begin for one in self._recent])
        known = self._changed_by.get(tooth, math.inf)
        if begins[0] >= known:
            return known, np.ones(len(begins), dtype=bool)
        onset = onset_of(amounts, sd)
        first, last = self._recent[onset.first], self._recent[onset.last]
        self._changed_by[tooth] = last.end
        # A step later than half of a block belongs to the next one.
        return first.begin - 0.5 * (first.end - first.begin), begins >= last.end

    def _loss(
        self, cell: Baseline, amounts: Array, after: NDArray[np.bool_], sd: float
    ) -> Estimate:
        """Loss of stiffness from the blocks after a change."""
        if not after.any():
            remedy = "the next hunting period"
            return not_identifiable("stiffness_loss", math.nan, "", remedy, "LEARNING")
        assert cell.bank is not None  # set with the cell
        torques = np.array([one.torque for one in self._recent])[after]
        scale, uncertain = self._scale(cell.bank, float(np.mean(torques)))
        if cell.taken_off:
            uncertain = UNSCALED
        loss = float(np.mean(amounts[after])) / scale
        spread = math.hypot(sd * cell.noise(torques) / scale, uncertain * loss)
        return estimated("stiffness_loss", loss, spread, "")

    def _record_event(self, tooth: int, state: ToothState, times: tuple[float, float]) -> None:
        """Add an event, with its earliest start and its detection [s], or update it."""
        size = state.loss
        reach = CONFIDENT * size.sd
        shown = (
            f"loss {100 * size.value:.2g} +- {100 * reach:.2g} %"
            if size.status == "ESTIMATED"
            else f"its size follows from {size.remedy}"
        )
        others = (
            f"; as likely: {', '.join(state.candidates[1:])}" if len(state.candidates) > 1 else ""
        )
        evidence = f"z = {state.z:.1f}, {shown}{others}"
        what = f"{state.gear} tooth {state.tooth} changed"
        if tooth not in self._place:
            self._place[tooth] = len(self.events)
            self.events.append(Event(what, *times, size, state.kinds, evidence))
            return
        place = self._place[tooth]
        self.events[place] = replace(
            self.events[place], size=size, causes=state.kinds, evidence=evidence
        )

    def _clear_teeth(self) -> None:
        """Report no changed tooth; teeth found before remain until the window is full."""
        if len(self._recent) >= WINDOWS[2]:
            self.teeth, self._amounts = (), {}

    def _scale(self, bank: Bank, torque: float) -> tuple[float, float]:
        """Factor on the signatures of the bank, and the uncertainty of a size."""
        line = self.compliance.present
        grown = torque / bank.torque
        if line is None or not line.significant:
            return grown, UNSCALED
        return grown * line.slope / bank.compliance, UNCERTAIN

    def _follow_known(self, block: HuntingBlock, torque: float, place: int) -> None:
        """Amounts of known teeth at a load that is being learned, from the nearest baseline."""
        near = [
            cell
            for cell in self._cells
            if cell.learned and cell.segment == block.segment and cell.torque * torque > 0.0
        ]
        if not near or not self._amounts:
            return
        cell = min(near, key=lambda one: abs(one.torque - torque))
        residual, measured = cell.residual(block, torque)
        self._note_amounts(residual, measured, (cell, place), torque)

    def _note_amounts(
        self,
        residual: Array,
        measured: NDArray[np.bool_],
        at: tuple[Baseline, int],
        torque: float,
    ) -> None:
        """Amount of every known tooth in one block, with the others subtracted."""
        cell, place = at
        assert cell.bank is not None  # set with the cell
        cycles = len(residual)
        for tooth in self._amounts:
            left = residual.copy()
            for other, amount in self._amounts.items():
                if other != tooth:
                    left -= amount * cell.bank.deviation(other, cycles) * measured
            products, squares = cell.bank.score(left, measured)
            sd = float(cell.sd[cell.bank.gear_of[tooth]])
            kind = self._kinds[tooth]
            kind.add(place, torque, float(products[tooth] / squares[tooth]), sd)
        self.teeth = tuple(self._with_kinds(state, cell.bank) for state in self.teeth)

    def _with_kinds(self, state: ToothState, bank: Bank) -> ToothState:
        """A state and its event, with the kinds that are possible now."""
        tooth = bank.teeth.index((state.gear, state.tooth))  # type: ignore[arg-type]
        kinds = self._kinds[tooth].kinds
        if kinds != state.kinds and tooth in self._place:
            place = self._place[tooth]
            self.events[place] = replace(self.events[place], causes=kinds)
        return state._replace(kinds=kinds)

    def _take_off_known(self, cell: Baseline, place: int) -> None:
        """Subtract a changed tooth from a baseline that was learned with it."""
        assert cell.bank is not None and cell.mean is not None  # it has been learned
        for tooth, kind in self._kinds.items():
            if tooth in self._amounts:
                cell.taken_off = True
                cell.mean -= kind.amount(place) * cell.bank.deviation(tooth, len(cell.mean))

    def remarks(self) -> Iterator[str]:
        """Reasons why the estimates are less certain, one line each."""
        if self._restored:
            yield self._restored
        if self._unmeasured:
            yield "encoders: the torque is not measured: that of the scene is assumed"
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
            self._estimates = self._of_compliance()
        return self._estimates

    def _of_compliance(self) -> tuple[Estimate, ...]:
        remedy = "a load that varies by some percent"
        line, both = self.compliance.present, self.compliance.both
        per_input = 1.0 / (self.train.lever * abs(float(self.train.twist[0])))
        if line is None:
            wait = "hunting periods with the torque measured"
            return tuple(
                not_identifiable(name, math.nan, unit, wait, "LEARNING")
                for name, unit in (
                    ("compliance", "rad/(N m)"), ("compliance_change", ""),
                    ("backlash_change", "m"),
                )
            )  # fmt: skip
        slope, sd = abs(line.slope) * per_input, line.sd * per_input
        found = [
            estimated("compliance", slope, sd, "rad/(N m)", remedy)
            if line.significant
            else not_identifiable("compliance", sd, "rad/(N m)", remedy)
        ]
        if both is None or not (both[0].significant and both[1].significant):
            status: Status = "LEARNING" if both is None else "NOT_IDENTIFIABLE"
            names = (("compliance_change", ""), ("backlash_change", "m"))
            return (
                *found,
                *(not_identifiable(name, math.nan, unit, remedy, status) for name, unit in names),
            )
        first, last = both
        change = last.slope / first.slope - 1.0
        width = math.hypot(last.sd, first.sd) / abs(first.slope)
        found.append(estimated("compliance_change", change, width, ""))
        now, here = last.at(*last.centre)
        then, there = first.at(*last.centre)
        found.append(
            estimated("backlash_change", 2.0 * (now - then), 2.0 * math.hypot(here, there), "m")
        )
        return tuple(found)


def _names(bank: Bank, teeth: tuple[int, ...]) -> tuple[str, ...]:
    return tuple(str(bank.teeth[tooth]) for tooth in teeth)
