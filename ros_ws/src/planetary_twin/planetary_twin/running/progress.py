"""The live line of a run in a terminal, or plain lines in a file or a pipe."""

from __future__ import annotations

import math
from typing import Self

from planetary_twin_msgs.msg import GearboxState
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn

_PLAIN_PERIOD = 1.0  # [s] simulated time between two plain lines


class Show:
    """
    Shows simulated time, speed, transmission error, losses and the real-time factor.

    `duration` [s] is the simulated time of the run.
    """

    def __init__(self, console: Console, duration: float) -> None:
        self._console = console
        self._duration = duration
        self._next_line = 0.0
        self._reason = ""  # why simulated time is halted
        self._bar = Progress(
            TextColumn("{task.completed:5.1f} / {task.total:g} s"),
            BarColumn(bar_width=24),
            TextColumn("{task.description}"),
            console=console,
            transient=True,
            refresh_per_second=5,
            disable=not console.is_terminal,
        )
        self._task = self._bar.add_task("starting", total=duration)

    def __enter__(self) -> Self:
        self._bar.start()
        return self

    def __exit__(self, *raised: object) -> None:
        self._bar.stop()

    def say(self, simulated: float, text: str) -> None:
        """Print `text` at the time `simulated` [s]."""
        self._console.print(f"{simulated:6.2f} s  {text}", highlight=False)

    def halt(self, simulated: float, reason: str) -> None:
        """Show that simulated time is halted at `simulated` [s], and the reason."""
        self._bar.update(self._task, description=reason)
        if not self._console.is_terminal and reason != self._reason:
            self.say(simulated, reason)
        self._reason = reason

    def update(self, state: GearboxState, real_time_factor: str) -> None:
        """Show the newest state."""
        line = _line(state, real_time_factor)
        self._bar.update(self._task, completed=state.simulated_time, description=line)
        self._reason = ""
        now = state.simulated_time
        due = now >= self._next_line or now < self._next_line - _PLAIN_PERIOD  # after a reset
        if not self._console.is_terminal and due:
            self._next_line = math.floor(now) + _PLAIN_PERIOD
            self.say(now, line)


def _line(state: GearboxState, real_time_factor: str) -> str:
    rpm = state.sun_speed * 30.0 / math.pi
    return (
        f"{rpm:6.0f} rpm  DTE {state.sun_planet_dte_mean[0] * 1e6:6.3f} um  "
        f"loss {state.power_loss:6.2f} W  real-time factor {real_time_factor}"
    )
