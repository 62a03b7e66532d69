"""A replay with a live line in the terminal."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn

from .managed import run_node
from .network import stay_on_this_machine
from .replay import Replay


class Bar:
    """The live line, and lines that stay above it."""

    def __init__(self, console: Console) -> None:
        self._console = console
        self.progress = Progress(
            BarColumn(bar_width=24),
            TextColumn("{task.description}"),
            console=console,
            transient=True,
            refresh_per_second=10,
            disable=not console.is_terminal,
        )
        self._task = self.progress.add_task("finding subscribers", total=None)

    def say(self, text: str) -> None:
        """A line that stays."""
        self._console.print(text, highlight=False, soft_wrap=True)

    def warn(self, text: str) -> None:
        """A line that the user should know of."""
        self._console.print(f"warning: {text}", style="yellow", highlight=False, soft_wrap=True)

    def move(self, played: float, length: float) -> None:
        """Show that `played` of `length` [s] are over."""
        text = f"{played:.1f} / {length:.1f} s"
        self.progress.update(self._task, completed=played, total=length, description=text)


def replay_shown(parameters: Mapping[str, Any]) -> int:
    """Run a replay node with these parameters to its end; returns the exit code."""
    stay_on_this_machine()
    bar = Bar(Console())

    with bar.progress:
        return run_node(lambda: Replay(parameters, bar), [], title="planetary-twin replay")
