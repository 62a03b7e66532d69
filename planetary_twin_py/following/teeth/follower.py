"""Estimates changes of teeth from two encoders: cracks, wear, compliance and backlash."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ...scene import Scene
from ..checks.encoder_check import EncoderCheck
from ..estimate import Estimate, Event
from ..input_error import InputError
from ..train import followed_train
from ..transmission_error import Counts
from .baseline import Baseline, LearnedCell
from .baseline_file import TeethBaseline
from .changed import ChangedTeeth, JudgedBlock, ToothState
from .compliance import Compliance
from .hunting_blocks import EncoderCounters, HuntingBlock, HuntingBlocks
from .scores import Bank
from .search import ALARM, Residual, find_teeth
from .signatures import signatures

Array = NDArray[np.float64]

MISPLACED = (
    "teeth: the loaded baseline belongs to another position of the encoders and is not used; a "
    "baseline is learned"
)
WINDOWS = 1, 4, 16, 64  # numbers of blocks that are judged together
WAITING = 64  # largest number of hunting periods that wait for readings of the torque
SPEED_STEP = 0.3  # relative difference of the speeds for which signatures are computed


@dataclass
class TeethFollower:
    """Learns baselines of operating cells from `learning` hunting periods; finds changed teeth."""

    scene: Scene
    counts_per_turn: tuple[int, int]
    period: float
    learning: int = 24
    events: list[Event] = field(init=False, default_factory=list)
    """Detected changes."""
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
            raise ValueError(
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
        self._start(Compliance(self.learning))

    def _start(self, compliance: Compliance) -> None:
        """Start without baselines and changed teeth."""
        self.compliance = compliance
        self._changed = ChangedTeeth(self.learning, compliance, self.events)
        self._cells: list[Baseline] = []
        self._restore_remark: str | None = None  # if the baseline does not fit
        self._unverified = False  # restored and not yet compared with a block
        self.every_z, self.outstanding = (), -math.inf
        self._recent: deque[JudgedBlock] = deque(maxlen=WINDOWS[-1])
        self._cell: int | None = None
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
        """Use saved baselines instead of learning; their encoders' counts have continued since.

        Raises `InputError` if they are of other encoders.
        """
        expected = self.counts_per_turn, self.period
        if (saved.counts_per_turn, saved.period) != expected:
            raise InputError(
                f"baseline: counts per turn {saved.counts_per_turn} and period {saved.period:g} s: "
                f"must be {expected[0]} and {expected[1]:g} s as of the encoders"
            )
        segment = self.counters.segments
        blocks = [tuple(block) for block in saved.blocks]
        self._start(Compliance(self.learning, segment, blocks))
        self._cells = [Baseline.of_fields(fields, segment) for fields in saved.cells]
        self._unverified = True

    @property
    def teeth(self) -> tuple[ToothState, ...]:
        """Teeth that have changed."""
        return self._changed.states

    @property
    def counters(self) -> EncoderCounters:
        """Numbers of samples that were not used, by reason."""
        return self._hunting.counters

    @property
    def cells(self) -> tuple[LearnedCell, ...]:
        """Learning state of each operating cell."""
        return tuple(cell.summary for cell in self._cells)

    def add(self, sample: Counts, counts: Counts) -> None:
        """Add samples in the order of their arrival: numbers (n,) in sample periods, counts (n, 2).

        Raises `InputError` if the encoders do not turn in the ratio of the teeth.
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
        """Judge the hunting periods that end by a time [s].

        `torque` returns the mean input torque between two times [N m]; if it is NaN, the torque of
        the scene is used.
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
                self._changed.subtract_from(cell, cell_index)
            return
        assert cell.bank is not None  # set with the cell
        self.compared += 1
        residual, measured = cell.residual(block, torque)
        products, squares = cell.bank.score(residual, measured)
        self._recent.append(
            JudgedBlock(residual, measured, products, squares, torque, block.begin, block.end)
        )
        self._changed.add(residual, measured, (cell, cell_index), torque)
        self._search_windows(cell)

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

    def _search_windows(self, cell: Baseline) -> None:
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
            self._changed.update(matches, cell, self._recent, cell.noise(torques[-window:]))
        else:
            self._clear_teeth()

    def _clear_teeth(self) -> None:
        """Report no changed tooth; teeth found before remain until the window is full."""
        if len(self._recent) >= WINDOWS[2]:
            self._changed.clear()

    def _follow_known_teeth(self, block: HuntingBlock, torque: float, cell_index: int) -> None:
        """Amounts of known teeth at a load that is being learned, from the nearest baseline."""
        candidates = [
            cell
            for cell in self._cells
            if cell.learned and cell.segment == block.segment and cell.torque * torque > 0.0
        ]
        if not candidates or not self._changed.any:
            return
        cell = min(candidates, key=lambda candidate: abs(candidate.torque - torque))
        residual, measured = cell.residual(block, torque)
        self._changed.add(residual, measured, (cell, cell_index), torque)

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
