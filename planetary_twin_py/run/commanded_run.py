"""A run with commands at given times."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator
from fractions import Fraction

import numpy as np

from .._core import WORK
from ..model.clock import TICKS
from ..scene import Scene, SceneError
from .commands import Action, Commands, actions
from .interface import Run
from .port_engine import DrivenEngine
from .samples import Samples

SPAN = Fraction(1, 100)  # [s] over which the power of a machine has one direction, that of its mean


class DrivenRun:
    """Advances a run, applies commands at their times, and adds up the work of the machines.

    Args:
        run: run from `run.start.start`.
        scene: scene of the run.
        commands: commands over time; None: the values at the ports stay as at the start.

    Raises:
        ValueError: a command is out of range, or its port does not accept it.
    """

    def __init__(self, run: Run, scene: Scene, commands: Commands | None) -> None:
        self._run, self._time = run, Fraction(0)
        self._work = np.zeros(int(run.train.machines))
        self.work = np.zeros((2, len(self._work)))
        """Work that each machine has put in, and that it has taken out [J], (2, machines)."""
        linear = scene.drive.interpolation == "linear"
        self._pending = deque(() if commands is None else actions(commands, linear))
        self._commanded = bool(self._pending)
        if not self._commanded:
            return
        if not isinstance(run, DrivenEngine):
            raise SceneError(f"dynamics = {scene.dynamics!r}: does not allow commands")
        for action in self._pending:
            action.command.check(scene.drive.ports, run.port_ranges)

    @property
    def first_unused(self) -> float | None:
        """Time of the first command that does not act so far [s]; None if all do."""
        late = (action.begin for action in self._pending if action.command.values)
        ticks = next(late, None)
        return None if ticks is None else ticks / TICKS

    def advance(self, until: float, first_sample: int, sample_rate: float, room: int) -> Samples:
        """Simulate until `until`, see `Run.advance`.

        Args:
            until: time [s].
            first_sample: number of the first sample.
            sample_rate: sample times are integer multiples of its inverse [Hz].
            room: number of samples.

        Returns:
            The samples.

        Raises:
            ValueError: a shaft cannot reach a position in time.
            RunawayError: the run exceeds physical limits.
        """
        parts, done = list[Samples](), 0

        def to(time: Fraction, due: int) -> None:
            nonlocal done
            parts.append(self._run.advance(time, first_sample + done, sample_rate, due - done))
            done = due
            self._add_work(time)

        for time, action in self._stops(Fraction(until)):
            due = math.floor(time * Fraction(sample_rate)) + 1 - first_sample
            to(time, min(max(due, done), room))
            if action is not None:
                self._apply(action)
        to(Fraction(until), room)
        return Samples(*map(np.concatenate, zip(*parts, strict=True)))

    def _stops(self, until: Fraction) -> Iterator[tuple[Fraction, Action | None]]:
        """Times before `until` [s] of the commands, and of ends of spans between them."""
        while self._pending and Fraction(self._pending[0].begin, TICKS) < until:
            action = self._pending.popleft()
            time = Fraction(action.begin, TICKS)
            yield from self._spans(time)
            yield time, action
        yield from self._spans(until)

    def _spans(self, end: Fraction) -> Iterator[tuple[Fraction, None]]:
        """Ends of equal spans of at most `SPAN` until `end` [s], without the last."""
        if not self._commanded:
            return  # nothing reverses the power of a machine
        begin = self._time
        count = math.ceil((end - begin) / SPAN)
        yield from ((begin + (end - begin) * n / count, None) for n in range(1, count))

    def _add_work(self, time: Fraction) -> None:
        """Add the work of the machines up to `time` [s], the end of a span."""
        before, self._time = self._work, time
        self._work = self._run.books(time).ledger[WORK : WORK + len(before)]
        self.work += np.maximum([self._work - before, before - self._work], 0.0)

    def _apply(self, action: Action) -> None:
        assert isinstance(self._run, DrivenEngine)
        self._run.apply_command(action.begin, action.end, action.command)
