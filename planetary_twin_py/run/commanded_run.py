"""Windows of a run with commands at given times."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator

from ..model.clock import TICKS
from ..scene import Scene, SceneError
from .commands import Action, Commands, actions
from .port_engine import DrivenEngine
from .window_jobs import run_alone
from .window_plan import Plan
from .windows import Windows


class CommandedRun:
    """Advances windows of a run, and applies commands at their times.

    Args:
        windows: the windows, at the start of the run.
        scene: scene of the run.
        commands: commands over time; None: the values at the ports stay as at the start.

    Raises:
        ValueError: a command is out of range, or its port does not accept it.
    """

    def __init__(self, windows: Windows, scene: Scene, commands: Commands | None) -> None:
        self._windows, self._run = windows, windows.run
        linear = scene.drive.interpolation == "linear"
        self._pending = deque(() if commands is None else actions(commands, linear))
        self.commanded = bool(self._pending)
        """Whether there are commands."""
        if not self.commanded:
            return
        if not isinstance(self._run, DrivenEngine):
            raise SceneError(f"dynamics = {scene.dynamics!r}: does not allow commands")
        for action in self._pending:
            action.command.check(scene.drive.ports, self._run.port_ranges)

    @property
    def first_unused(self) -> float | None:
        """Time of the first command that does not act so far [s]; None if all do."""
        late = (action.begin for action in self._pending if action.command.values)
        ticks = next(late, None)
        return None if ticks is None else ticks / TICKS

    def advance(
        self, until: int, rate: float, longest: int | None, sampled: bool = True
    ) -> Iterator[Plan]:
        """Simulate window by window.

        Args:
            until: end of the last window [ticks of the clock].
            rate: sample rate [Hz].
            longest: longest window [ticks]; None: windows end at commands only.
            sampled: whether windows have samples.

        Yields:
            Each window after it is closed.

        Raises:
            ValueError: a shaft cannot reach a position in time.
            RunawayError: the run exceeds physical limits.
        """
        acting: Action | None = None
        for end, action in self._stops(until):
            while (begin := self._windows.ticks) < end:
                within = end if longest is None else min(begin + longest, end)
                plan = self._windows.plan(within, rate, sampled)
                if acting is not None and acting.begin == begin:
                    plan = plan._replace(given=acting.command.values)
                run_alone(self._windows.jobs(plan))
                yield self._windows.close(plan)
            if action is not None:
                assert isinstance(self._run, DrivenEngine)
                self._run.apply_command(action.begin, action.end, action.command)
                acting = action

    def _stops(self, until: int) -> Iterator[tuple[int, Action | None]]:
        """Times of the commands before `until` [ticks], and `until`."""
        while self._pending and self._pending[0].begin < until:
            action = self._pending.popleft()
            yield action.begin, action
        yield until, None
