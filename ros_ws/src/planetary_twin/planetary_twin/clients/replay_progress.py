"""A replay with a live line in the terminal."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn

from planetary_twin_py.terminal.console import make_console

from ..base.spin import run_node
from ..replay.node import Display, Replay
from .loopback import stay_on_this_machine


class Bar(Display):
    """The live line on `console`, and lines printed above it."""

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
        self._task = self.progress.add_task("waiting for subscribers", total=None)

    def say(self, text: str) -> None:
        """Print a line."""
        self._console.print(text, highlight=False, soft_wrap=True)

    def warn(self, text: str) -> None:
        """Print a warning."""
        self._console.print(f"warning: {text}", style="yellow", highlight=False, soft_wrap=True)

    def move(self, instant: float, end: float) -> None:
        """Show the position `instant` [s] in the recording, which is played to `end` [s]."""
        text = f"{instant:.1f} / {end:.1f} s"
        self.progress.update(self._task, completed=instant, total=end, description=text)


def replay_shown(parameters: Mapping[str, Any], remappings: Sequence[str]) -> int:
    """
    Run a replay node with `parameters` to its end; returns the exit code.

    `remappings` have the form OLD:=NEW of ROS.
    """
    stay_on_this_machine()
    bar = Bar(make_console())
    rules = [word for rule in remappings for word in ("-r", rule)]
    args = ["--ros-args", *rules] if rules else []
    with bar.progress:
        return run_node(lambda: Replay(parameters, bar), args, "planetary-twin", refusal=2)
