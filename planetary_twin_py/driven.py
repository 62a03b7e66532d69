"""A run with commands at given times."""

from __future__ import annotations

import math
from collections import deque
from fractions import Fraction

import numpy as np

from .commands import Action, Commands, actions
from .driven_engine import DrivenEngine
from .integrators.clock import TICKS
from .integrators.interpolant import Samples
from .run import Run
from .scene import Scene, SceneError


class DrivenRun:
    """Advances a run, and applies commands at their times.

    Args:
        run: run from `run.start`.
        scene: scene of the run.
        commands: commands over time; None: the values at the ports stay as at the start.

    Raises:
        ValueError: a command is out of range, or its port does not accept it.
    """

    def __init__(self, run: Run, scene: Scene, commands: Commands | None) -> None:
        self._run = run
        linear = scene.drive.interpolation == "linear"
        self._pending = deque(() if commands is None else actions(commands, linear))
        if not self._pending:
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
        while self._pending and Fraction(self._pending[0].begin, TICKS) < until:
            action = self._pending.popleft()
            time = Fraction(action.begin, TICKS)
            due = min(max(math.floor(time * Fraction(sample_rate)) + 1 - first_sample, done), room)
            parts.append(self._run.advance(time, first_sample + done, sample_rate, due - done))
            done = due
            self._apply(action)
        parts.append(self._run.advance(until, first_sample + done, sample_rate, room - done))
        return Samples(*map(np.concatenate, zip(*parts, strict=True)))

    def _apply(self, action: Action) -> None:
        assert isinstance(self._run, DrivenEngine)
        self._run.apply_command(action.begin, action.end, action.command)
